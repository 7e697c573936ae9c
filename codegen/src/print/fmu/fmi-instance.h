/* What is set of one machine, and what comes of it. `fmi-machine.h` says which machine. */
#ifndef FMI_INSTANCE_H
#define FMI_INSTANCE_H

#include "fmi-machine.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* FMI hands over more than is needed here. */
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wunused-parameter"
#endif

/* Statuses: OK and Error of FMI 2.0 and 3.0. */
enum { FINE = 0, FAULT = 3 };

typedef struct {
    /* By their value references: time, inputs, parameters, outputs. */
    double values[VALUES];
    /* What the function of the corrected commands returned. */
    int correction;
    /* Whether the outputs are those of the inputs and parameters. */
    int is_evaluated;
    /* Why they cannot be had, or what else went wrong. */
    const char *message;
} machine;

/* As it is before anything is set. */
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

/* Computes the outputs, if something was set. */
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
            return fault(m, "No number has this value reference.");
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

/* There is one whole number. */
static int get_whole_numbers(machine *m, const unsigned *references, size_t count, int *values)
{
    for (size_t k = 0; k < count; k++) {
        if (references[k] != AT_CORRECTION) {
            return fault(m, "No whole number has this value reference.");
        }
        if (update(m) != FINE) {
            return FAULT;
        }
        values[k] = m->correction;
    }
    return FINE;
}

/* What is not offered, or is about things of which there are none. */
static int only_nothing(machine *m, size_t count)
{
    return (count == 0U) ? FINE : fault(m, "There are no such variables.");
}

static int not_offered(machine *m)
{
    return fault(m, "modelDescription.xml does not offer this.");
}

/* Whether the description that was read is that of this machine. */
static int is_described_by(machine *m, const char *token)
{
    if (token == NULL || strcmp(token, TOKEN) != 0) {
        return fault(m, "modelDescription.xml is that of another machine.");
    }
    return FINE;
}

#endif
