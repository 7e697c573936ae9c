/* On a board without an operating system: the self-test, then the instructions and the stack of compensated commands. */
#include HEADER

extern char stack_top;
int main(void);

/* A request of the debugger's host (semihosting). */
static int host(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
    return r0;
}

static void print(const char *text)
{
    (void)host(4, text);
}

static void print_number(unsigned number)
{
    char digits[12];
    int at = 11;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + (int)(number % 10U));
        number /= 10U;
    } while (number > 0U);
    print(&digits[at]);
}

static void reset(void)
{
    *(volatile unsigned *)0xE000ED88U |= 0xFU << 20; /* the floating-point unit */
    __asm__ volatile("dsb\n isb");
    const unsigned end[2] = { 0x20026U, (unsigned)main() };
    (void)host(0x20, end);
    for (;;) {
    }
}

static const struct {
    const void *stack;
    void (*start)(void);
} vectors __attribute__((section(".vectors"), used)) = { &stack_top, reset };

/* Runs one cycle in a frame of its own. */
static int __attribute__((noinline)) cycle(const REAL *q, REAL *last)
{
    REAL corrected[NAME(VARIABLES)];
    REAL before[6];
    REAL after[6];
    return CALL(compensated)(q, PARAMETERS INPUTS last, CALL(change), CALL(largest), CALL(whole_pose), corrected, last, before,
                             after);
}

/* Fills the free stack below the caller with a pattern, and returns its end. */
static volatile unsigned char *paint(void)
{
    volatile unsigned char *const top = __builtin_frame_address(0);
    for (int k = 64; k < 65536; k++) {
        top[-k] = 0xA5U;
    }
    return top;
}

/* Returns the number of painted bytes that have been overwritten. */
static unsigned used(volatile unsigned char *top)
{
    unsigned k = 65535U;
    while (k > 64U && top[-(int)k] == 0xA5U) {
        k--;
    }
    return k;
}

#define COMMANDS 200

static volatile unsigned *const control = (volatile unsigned *)0xE000E010U;
static volatile unsigned *const reload = (volatile unsigned *)0xE000E014U;
static volatile unsigned *const value = (volatile unsigned *)0xE000E018U;

/* Runs one cycle, and returns its instructions. */
static unsigned measured(const REAL *q, REAL *last, int *status)
{
    *reload = 0xFFFFFFU;
    *value = 0U;
    *control = 5U;
    const unsigned begun = *value;
    *status = cycle(q, last);
    return ((begun - *value) & 0xFFFFFFU) * TICK;
}

/* Returns a number from 0 to 1, another one at each call. */
static REAL any(void)
{
    static unsigned state = 1U;
    state = 1664525U * state + 1013904223U;
    return (REAL)(state >> 8) / (REAL)0x1000000;
}

int main(void)
{
    REAL q[NAME(VARIABLES)];
    REAL last[NAME(VARIABLES)] = { (REAL)0 };
    int status = 0;
    const int wrong = CALL(self_test)();
    print("self-test ");
    print(wrong == 0 ? "passed" : "FAILED");
    for (int j = 0; j < NAME(VARIABLES); j++) {
        const REAL *const limits = CALL(limits)[j];
        q[j] = limits[0] + (REAL)(6 + j) / (REAL)20 * (limits[1] - limits[0]);
    }
    volatile unsigned char *const top = paint();
    print(", instructions: first cycle ");
    print_number(measured(q, last, &status));
    unsigned count = 0U;
    for (int k = 0; k < 40; k++) {
        count = measured(q, last, &status);
    }
    print(", settled ");
    print_number(count);
    print(status == 0 ? "" : " (not reached)");
    unsigned most = 0U;
    for (int k = 0; k < COMMANDS; k++) {
        for (int j = 0; j < NAME(VARIABLES); j++) {
            const REAL *const limits = CALL(limits)[j];
            q[j] = limits[0] + any() * (limits[1] - limits[0]);
            last[j] = ((REAL)2 * any() - (REAL)1) * CALL(largest)[j];
        }
        count = measured(q, last, &status);
        most = count > most ? count : most;
    }
    print(", most of ");
    print_number(COMMANDS);
    print(" ");
    print_number(most);
    print("; stack used ");
    print_number(used(top));
    print(" B");
    print("\n");
    return wrong;
}
