/* Implementation of FMI 3.0: co-simulation and model exchange, without states and events, with the
 * declarations of the standard (fmi-standard.org). FMI3_FUNCTION_PREFIX, if defined, prefixes all names,
 * for several machines in one program. */
#include "fmi-instance.h"

#include <stdbool.h>
#include <stdint.h>

#define JOIN(a, b) a##b
#define JOINED(a, b) JOIN(a, b)
#if defined(FMI3_FUNCTION_PREFIX) && !defined(FMI3_OVERRIDE_FUNCTION_PREFIX)
#define NAMED(name) JOINED(FMI3_FUNCTION_PREFIX, name)
#else
#define NAMED(name) name
#endif

#ifndef FMI3_Export
#if defined(_WIN32) || defined(__CYGWIN__)
#define FMI3_Export __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI3_Export __attribute__((visibility("default")))
#else
#define FMI3_Export
#endif
#endif

typedef int status;
typedef uint32_t reference;
typedef void (*log_message)(void *environment, status, const char *category, const char *message);
typedef void (*clock_update)(void *environment);
typedef void (*lock_preemption)(void);
typedef void (*intermediate_update)(void *environment, double time, bool set_requested, bool get_allowed, bool finished,
    bool can_return, bool *return_requested, double *return_time);

typedef struct {
    machine machine;
    void *environment;
    log_message log;
} instance;

static status said(instance *i, status of)
{
    if (of != FINE && i->log != NULL) {
        i->log(i->environment, of, "logStatusError", i->machine.message);
    }
    return of;
}

#define FUNCTION(result, name) FMI3_Export result NAMED(name)
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

FUNCTION(const char *, fmi3GetVersion)(void)
{
    return "3.0";
}

NOTHING_TO_DO(fmi3SetDebugLogging, bool on, size_t count, const char *const categories[])

static instance *instantiated(const char *token, void *environment, log_message log)
{
    instance *i = calloc(1, sizeof(instance));
    if (i == NULL) {
        return NULL;
    }
    i->environment = environment;
    i->log = log;
    begin(&i->machine);
    if (said(i, is_described_by(&i->machine, token)) != FINE) {
        free(i);
        return NULL;
    }
    return i;
}

FUNCTION(instance *, fmi3InstantiateModelExchange)(const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, log_message log)
{
    return instantiated(token, environment, log);
}

FUNCTION(instance *, fmi3InstantiateCoSimulation)(const char *name, const char *token, const char *resources, bool visible,
    bool logging, bool events, bool early_return, const reference intermediate[], size_t count, void *environment, log_message log,
    intermediate_update update)
{
    return instantiated(token, environment, log);
}

FUNCTION(instance *, fmi3InstantiateScheduledExecution)(const char *name, const char *token, const char *resources, bool visible,
    bool logging, void *environment, log_message log, clock_update update, lock_preemption lock, lock_preemption unlock)
{
    return NULL;
}

FUNCTION(void, fmi3FreeInstance)(instance *i)
{
    free(i);
}

FUNCTION(status, fmi3EnterInitializationMode)(instance *i, bool tolerance_given, double tolerance, double start, bool stop_given,
    double stop)
{
    i->machine.values[AT_TIME] = start;
    return FINE;
}

NOTHING_TO_ENTER(fmi3ExitInitializationMode)
NOTHING_TO_ENTER(fmi3EnterConfigurationMode)
NOTHING_TO_ENTER(fmi3ExitConfigurationMode)
NOTHING_TO_ENTER(fmi3EnterStepMode)
NOTHING_TO_ENTER(fmi3EnterEventMode)
NOTHING_TO_ENTER(fmi3EnterContinuousTimeMode)
NOTHING_TO_ENTER(fmi3EvaluateDiscreteStates)
NOTHING_TO_ENTER(fmi3Terminate)

FUNCTION(status, fmi3Reset)(instance *i)
{
    begin(&i->machine);
    return FINE;
}

/* Values. */

FUNCTION(status, fmi3GetFloat64)(instance *i, const reference references[], size_t count, double values[], size_t values_count)
{
    return said(i, get_numbers(&i->machine, references, count, values));
}

FUNCTION(status, fmi3SetFloat64)(instance *i, const reference references[], size_t count, const double values[], size_t values_count)
{
    return said(i, set_numbers(&i->machine, references, count, values));
}

FUNCTION(status, fmi3GetInt32)(instance *i, const reference references[], size_t count, int32_t values[], size_t values_count)
{
    return said(i, get_whole_numbers(&i->machine, references, count, values));
}

NO_VARIABLES(fmi3GetFloat32, float values[], size_t values_count)
NO_VARIABLES(fmi3GetInt8, int8_t values[], size_t values_count)
NO_VARIABLES(fmi3GetUInt8, uint8_t values[], size_t values_count)
NO_VARIABLES(fmi3GetInt16, int16_t values[], size_t values_count)
NO_VARIABLES(fmi3GetUInt16, uint16_t values[], size_t values_count)
NO_VARIABLES(fmi3GetUInt32, uint32_t values[], size_t values_count)
NO_VARIABLES(fmi3GetInt64, int64_t values[], size_t values_count)
NO_VARIABLES(fmi3GetUInt64, uint64_t values[], size_t values_count)
NO_VARIABLES(fmi3GetBoolean, bool values[], size_t values_count)
NO_VARIABLES(fmi3GetString, const char *values[], size_t values_count)
NO_VARIABLES(fmi3GetBinary, size_t sizes[], const uint8_t *values[], size_t values_count)
NO_VARIABLES(fmi3GetClock, bool values[])
NO_VARIABLES(fmi3SetFloat32, const float values[], size_t values_count)
NO_VARIABLES(fmi3SetInt8, const int8_t values[], size_t values_count)
NO_VARIABLES(fmi3SetUInt8, const uint8_t values[], size_t values_count)
NO_VARIABLES(fmi3SetInt16, const int16_t values[], size_t values_count)
NO_VARIABLES(fmi3SetUInt16, const uint16_t values[], size_t values_count)
NO_VARIABLES(fmi3SetInt32, const int32_t values[], size_t values_count)
NO_VARIABLES(fmi3SetUInt32, const uint32_t values[], size_t values_count)
NO_VARIABLES(fmi3SetInt64, const int64_t values[], size_t values_count)
NO_VARIABLES(fmi3SetUInt64, const uint64_t values[], size_t values_count)
NO_VARIABLES(fmi3SetBoolean, const bool values[], size_t values_count)
NO_VARIABLES(fmi3SetString, const char *const values[], size_t values_count)
NO_VARIABLES(fmi3SetBinary, const size_t sizes[], const uint8_t *const values[], size_t values_count)
NO_VARIABLES(fmi3SetClock, const bool values[])
NO_VARIABLES(fmi3GetIntervalDecimal, double intervals[], int qualifiers[])
NO_VARIABLES(fmi3GetIntervalFraction, uint64_t counters[], uint64_t resolutions[], int qualifiers[])
NO_VARIABLES(fmi3GetShiftDecimal, double shifts[])
NO_VARIABLES(fmi3GetShiftFraction, uint64_t counters[], uint64_t resolutions[])
NO_VARIABLES(fmi3SetIntervalDecimal, const double intervals[])
NO_VARIABLES(fmi3SetIntervalFraction, const uint64_t counters[], const uint64_t resolutions[])
NO_VARIABLES(fmi3SetShiftDecimal, const double shifts[])
NO_VARIABLES(fmi3SetShiftFraction, const uint64_t counters[], const uint64_t resolutions[])
NO_VARIABLES(fmi3GetOutputDerivatives, const int32_t orders[], double values[], size_t values_count)

NOT_OFFERED(fmi3GetNumberOfVariableDependencies, reference of, size_t *count)
NOT_OFFERED(fmi3GetVariableDependencies, reference of, size_t elements[], reference on[], size_t elements_on[], int kinds[],
    size_t count)
NOT_OFFERED(fmi3GetFMUState, void **state)
NOT_OFFERED(fmi3SetFMUState, void *state)
NOT_OFFERED(fmi3FreeFMUState, void **state)
NOT_OFFERED(fmi3SerializedFMUStateSize, void *state, size_t *size)
NOT_OFFERED(fmi3SerializeFMUState, void *state, uint8_t bytes[], size_t size)
NOT_OFFERED(fmi3DeserializeFMUState, const uint8_t bytes[], size_t size, void **state)
NOT_OFFERED(fmi3GetDirectionalDerivative, const reference of[], size_t of_count, const reference by[], size_t by_count,
    const double seed[], size_t seed_count, double sensitivity[], size_t sensitivity_count)
NOT_OFFERED(fmi3GetAdjointDerivative, const reference of[], size_t of_count, const reference by[], size_t by_count,
    const double seed[], size_t seed_count, double sensitivity[], size_t sensitivity_count)
NOT_OFFERED(fmi3ActivateModelPartition, reference clock, double time)

/* Co-simulation: inputs are constant during a step. */

FUNCTION(status, fmi3DoStep)(instance *i, double from, double step, bool no_state_set, bool *events, bool *terminate, bool *early,
    double *last)
{
    const status of = said(i, update(&i->machine));
    if (of == FINE) {
        i->machine.values[AT_TIME] = from + step;
    }
    *events = false;
    *terminate = false;
    *early = false;
    *last = (of == FINE) ? from + step : from;
    return of;
}

/* Model exchange: outputs depend on the current inputs only. */

FUNCTION(status, fmi3UpdateDiscreteStates)(instance *i, bool *again, bool *terminate, bool *nominals, bool *states, bool *next_given,
    double *next)
{
    *again = false;
    *terminate = false;
    *nominals = false;
    *states = false;
    *next_given = false;
    return FINE;
}

FUNCTION(status, fmi3CompletedIntegratorStep)(instance *i, bool no_state_set, bool *event, bool *terminate)
{
    *event = false;
    *terminate = false;
    return FINE;
}

FUNCTION(status, fmi3SetTime)(instance *i, double time)
{
    i->machine.values[AT_TIME] = time;
    return FINE;
}

FUNCTION(status, fmi3GetNumberOfEventIndicators)(instance *i, size_t *count)
{
    *count = 0;
    return FINE;
}

FUNCTION(status, fmi3GetNumberOfContinuousStates)(instance *i, size_t *count)
{
    *count = 0;
    return FINE;
}

NO_STATES(fmi3SetContinuousStates, const double states[])
NO_STATES(fmi3GetContinuousStates, double states[])
NO_STATES(fmi3GetContinuousStateDerivatives, double derivatives[])
NO_STATES(fmi3GetNominalsOfContinuousStates, double nominals[])
NO_STATES(fmi3GetEventIndicators, double indicators[])
