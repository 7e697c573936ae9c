/* State of one instance. `fmi-machine.h` describes the machine. */
#ifndef FMI_INSTANCE_H
#define FMI_INSTANCE_H

#include "fmi-machine.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* FMI passes more arguments than are needed here. */
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

/* Status codes OK and Error of FMI 2.0 and 3.0. */
enum { FINE = 0, FAULT = 3 };

typedef struct {
    /* Indexed by value references: time, inputs, parameters, outputs. */
    double values[VALUES];
    /* Status of the corrected commands. */
    int correction;
    /* 1 if the outputs belong to the current inputs and parameters. */
    int is_evaluated;
    /* Last error message. */
    const char *message;
} machine;

/* Sets all start values. */
static void begin(machine *m)
{
    memcpy(m->values, START, sizeof(START));
    m->is_evaluated = 0;
}

static int fault(machine *m, const char *message)
{
    m->message = message;
    return FAULT;
}

/* Computes the outputs if an input or parameter has changed. */
static int update(machine *m)
{
    if (m->is_evaluated == 0) {
        m->message = evaluate(m->values, &m->correction);
        if (m->message != NULL) {
            return FAULT;
        }
        m->is_evaluated = 1;
    }
    return FINE;
}

static int get_numbers(machine *m, const unsigned *references, size_t count, double *values)
{
    for (size_t k = 0; k < count; k++) {
        if (references[k] >= VALUES) {
            return fault(m, "There is no real variable with this value reference.");
        }
        if (references[k] >= AT_OUTPUTS && update(m) != FINE) {
            return FAULT;
        }
        values[k] = m->values[references[k]];
    }
    return FINE;
}

static int set_numbers(machine *m, const unsigned *references, size_t count, const double *values)
{
    for (size_t k = 0; k < count; k++) {
        if (references[k] == AT_TIME || references[k] >= AT_OUTPUTS) {
            return fault(m, "Only inputs and parameters can be set.");
        }
        m->values[references[k]] = values[k];
        m->is_evaluated = 0;
    }
    return FINE;
}

/* There is a single integer variable. */
static int get_whole_numbers(machine *m, const unsigned *references, size_t count, int *values)
{
    for (size_t k = 0; k < count; k++) {
        if (references[k] != AT_CORRECTION) {
            return fault(m, "There is no integer variable with this value reference.");
        }
        if (update(m) != FINE) {
            return FAULT;
        }
        values[k] = m->correction;
    }
    return FINE;
}

/* Functions that are not supported, or are about variables that do not exist. */
static int only_nothing(machine *m, size_t count)
{
    return (count == 0U) ? FINE : fault(m, "There are no variables of this type.");
}

static int not_offered(machine *m)
{
    return fault(m, "modelDescription.xml does not declare this capability.");
}

/* Checks that the description belongs to this machine. */
static int is_described_by(machine *m, const char *token)
{
    if (token == NULL || strcmp(token, TOKEN) != 0) {
        return fault(m, "modelDescription.xml belongs to another machine.");
    }
    return FINE;
}

#endif
