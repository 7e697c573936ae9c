/* Implementation of FMI 2.0: co-simulation and model exchange, without states and events, with the
 * declarations of the standard (fmi-standard.org). FMI2_FUNCTION_PREFIX, if defined, prefixes all names,
 * for several machines in one program. */
#include "fmi-instance.h"

#define JOIN(a, b) a##b
#define JOINED(a, b) JOIN(a, b)
#if defined(FMI2_FUNCTION_PREFIX) && !defined(FMI2_OVERRIDE_FUNCTION_PREFIX)
#define NAMED(name) JOINED(FMI2_FUNCTION_PREFIX, name)
#else
#define NAMED(name) name
#endif

#ifndef FMI2_Export
#if defined(_WIN32) || defined(__CYGWIN__)
#define FMI2_Export __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_Export __attribute__((visibility("default")))
#else
#define FMI2_Export
#endif
#endif

typedef int status;
enum { DISCARD = 2 };
typedef int boolean;
typedef unsigned reference;

typedef struct {
    void (*log)(void *environment, const char *name, status, const char *category, const char *message, ...);
    void *(*allocate)(size_t count, size_t size);
    void (*release)(void *);
    void (*step_finished)(void *environment, status);
    void *environment;
} callbacks;

typedef struct {
    boolean again;
    boolean terminate;
    boolean nominals_changed;
    boolean states_changed;
    boolean next_given;
    double next;
} event_info;

typedef struct {
    machine machine;
    const callbacks *callbacks;
    char *name;
} instance;

static status said(instance *i, status of)
{
    if (of != FINE && i->callbacks != NULL && i->callbacks->log != NULL) {
        i->callbacks->log(i->callbacks->environment, i->name, of, "logStatusError", i->machine.message);
    }
    return of;
}

#define FUNCTION(result, name) FMI2_Export result NAMED(name)
#define NOTHING_TO_DO(name, ...) FUNCTION(status, name)(instance * i, __VA_ARGS__) { return FINE; }
#define NOTHING_TO_ENTER(name) FUNCTION(status, name)(instance * i) { return FINE; }
#define NOT_OFFERED(name, ...) \
    FUNCTION(status, name)(instance * i, __VA_ARGS__) { return said(i, not_offered(&i->machine)); }
#define NO_VARIABLES(name, ...)                                                                    \
    FUNCTION(status, name)(instance * i, const reference references[], size_t count, __VA_ARGS__) \
    {                                                                                              \
        return said(i, only_nothing(&i->machine, count));                                          \
    }
#define NO_STATES(name, ...) FUNCTION(status, name)(instance * i, __VA_ARGS__, size_t count) { return FINE; }

FUNCTION(const char *, fmi2GetTypesPlatform)(void)
{
    return "default";
}

FUNCTION(const char *, fmi2GetVersion)(void)
{
    return "2.0";
}

NOTHING_TO_DO(fmi2SetDebugLogging, boolean on, size_t count, const char *const categories[])

FUNCTION(void, fmi2FreeInstance)(instance *i)
{
    if (i != NULL) {
        free(i->name);
        free(i);
    }
}

FUNCTION(instance *, fmi2Instantiate)(const char *name, int type, const char *token, const char *resources,
    const callbacks *functions, boolean visible, boolean logging)
{
    instance *i = calloc(1, sizeof(instance));
    const size_t length = (name == NULL) ? 0U : strlen(name);
    char *copy = calloc(length + 1U, 1);
    if (i == NULL || copy == NULL) {
        free(i);
        free(copy);
        return NULL;
    }
    if (length > 0U) {
        memcpy(copy, name, length);
    }
    i->name = copy;
    i->callbacks = functions;
    begin(&i->machine);
    if (said(i, is_described_by(&i->machine, token)) != FINE) {
        free(copy);
        free(i);
        return NULL;
    }
    return i;
}

FUNCTION(status, fmi2SetupExperiment)(instance *i, boolean tolerance_given, double tolerance, double start, boolean stop_given,
    double stop)
{
    i->machine.values[AT_TIME] = start;
    return FINE;
}

NOTHING_TO_ENTER(fmi2EnterInitializationMode)
NOTHING_TO_ENTER(fmi2ExitInitializationMode)
NOTHING_TO_ENTER(fmi2EnterEventMode)
NOTHING_TO_ENTER(fmi2EnterContinuousTimeMode)
NOTHING_TO_ENTER(fmi2Terminate)

FUNCTION(status, fmi2Reset)(instance *i)
{
    begin(&i->machine);
    return FINE;
}

/* Values. */

FUNCTION(status, fmi2GetReal)(instance *i, const reference references[], size_t count, double values[])
{
    return said(i, get_numbers(&i->machine, references, count, values));
}

FUNCTION(status, fmi2SetReal)(instance *i, const reference references[], size_t count, const double values[])
{
    return said(i, set_numbers(&i->machine, references, count, values));
}

FUNCTION(status, fmi2GetInteger)(instance *i, const reference references[], size_t count, int values[])
{
    return said(i, get_whole_numbers(&i->machine, references, count, values));
}

NO_VARIABLES(fmi2GetBoolean, boolean values[])
NO_VARIABLES(fmi2GetString, const char *values[])
NO_VARIABLES(fmi2SetInteger, const int values[])
NO_VARIABLES(fmi2SetBoolean, const boolean values[])
NO_VARIABLES(fmi2SetString, const char *const values[])
NO_VARIABLES(fmi2SetRealInputDerivatives, const int orders[], const double values[])
NO_VARIABLES(fmi2GetRealOutputDerivatives, const int orders[], double values[])

NOT_OFFERED(fmi2GetFMUstate, void **state)
NOT_OFFERED(fmi2SetFMUstate, void *state)
NOT_OFFERED(fmi2FreeFMUstate, void **state)
NOT_OFFERED(fmi2SerializedFMUstateSize, void *state, size_t *size)
NOT_OFFERED(fmi2SerializeFMUstate, void *state, char bytes[], size_t size)
NOT_OFFERED(fmi2DeSerializeFMUstate, const char bytes[], size_t size, void **state)
NOT_OFFERED(fmi2GetDirectionalDerivative, const reference of[], size_t of_count, const reference by[], size_t by_count,
    const double seed[], double sensitivity[])

/* Co-simulation: inputs are constant during a step. */

FUNCTION(status, fmi2DoStep)(instance *i, double from, double step, boolean no_state_set)
{
    const status of = said(i, update(&i->machine));
    i->machine.values[AT_TIME] = (of == FINE) ? from + step : from;
    return of;
}

NOTHING_TO_ENTER(fmi2CancelStep)

/* Status of pending steps, of which there are none. */
#define NO_ANSWER(name, type) FUNCTION(status, name)(instance * i, int question, type *value) { return DISCARD; }

NO_ANSWER(fmi2GetStatus, status)
NO_ANSWER(fmi2GetRealStatus, double)
NO_ANSWER(fmi2GetIntegerStatus, int)
NO_ANSWER(fmi2GetBooleanStatus, boolean)
NO_ANSWER(fmi2GetStringStatus, const char *)

/* Model exchange: outputs depend on the current inputs only. */

FUNCTION(status, fmi2NewDiscreteStates)(instance *i, event_info *info)
{
    info->again = 0;
    info->terminate = 0;
    info->nominals_changed = 0;
    info->states_changed = 0;
    info->next_given = 0;
    return FINE;
}

FUNCTION(status, fmi2CompletedIntegratorStep)(instance *i, boolean no_state_set, boolean *event, boolean *terminate)
{
    *event = 0;
    *terminate = 0;
    return FINE;
}

FUNCTION(status, fmi2SetTime)(instance *i, double time)
{
    i->machine.values[AT_TIME] = time;
    return FINE;
}

NO_STATES(fmi2SetContinuousStates, const double states[])
NO_STATES(fmi2GetContinuousStates, double states[])
NO_STATES(fmi2GetDerivatives, double derivatives[])
NO_STATES(fmi2GetNominalsOfContinuousStates, double nominals[])
NO_STATES(fmi2GetEventIndicators, double indicators[])
