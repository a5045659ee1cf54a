/* One instance of the FMU: tables, everything that changes, and what the host has said about logging. */
#ifndef AXCOMP_INSTANCE_H
#define AXCOMP_INSTANCE_H

#include <stdbool.h>

#include "fmi2.h"
#include "image.h"
#include "resource.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where the instance is in the state machine of FMI 2.0 (section 4.2.4); bits, so that calls can name several. */
typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8 } Phase;

/* The variables that the kernel does not know. */
typedef struct {
    double cycle_time;
    int32_t largest_step;  /* in cycles */
    bool reload;
    char update_path[PATH_LENGTH];
} Controls;

/* Everything that changes; a copy of it is a snapshot. */
typedef struct {
    State state;
    Inputs inputs;
    Outputs outputs;
    Controls controls;
    double start_time;  /* s */
    double cycles;      /* run so far */
    Phase phase;
    bool reload_seen;   /* `reload` was on in the last step: there is no edge until it has been off */
    bool refused;       /* the update that waits for the next step was refused */
} Memory;

typedef struct {
    fmi2CallbackFunctions callbacks;
    char *name;
    char own_path[PATH_LENGTH];  /* of the image that belongs to this FMU; "": it is in the sources */
    bool logging;
    unsigned categories;  /* bit k: category k of axcomp_log_categories */
    Lists *lists;         /* in force; those that a state may come back to hang behind `first` */
    Lists *waiting;       /* read by `reload`, for the next step; NULL: none */
    Lists *first;
    Memory memory;
    State preview;        /* of the cycle that is computed during initialization, without being run */
    uint32_t told[KINDS]; /* bit i: that a kind of compensation of axis i has been used beyond its table */
} Instance;

enum { CATEGORY_WARNING, CATEGORY_ERROR, CATEGORY_ALL, CATEGORIES };
extern const char *const axcomp_log_categories[CATEGORIES];

/* Tell the host; errors always, the rest if it wants to know. Returns `status`. */
fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...);

/* Put the instance back to what it is right after instantiation. */
void axcomp_begin_again(Instance *instance);

/* Read the tables of an image, "": the one in the sources. Returns lists that hang nowhere yet, or NULL after telling
 * the host with `status` what is wrong; `call`: who wants them. */
Lists *axcomp_read_lists(const Instance *instance, fmi2Status status, const char *call, const char *path);

/* Look at `reload` and `update_path`, of which one has been set. On a rising edge the image is read (an empty path: the
 * FMU's own one); the next step takes or refuses it. `path_set`: what was read before may be another one. */
void axcomp_watch_reload(Instance *instance, bool path_set);

/* The instance's lists with an identity, NULL if it has none. */
Lists *axcomp_lists_with(const Instance *instance, uint32_t identity);

/* Note that a state in memory refers to lists (`by` 1), or no longer does (-1). */
void axcomp_hold_lists(Instance *instance, uint32_t identity, int by);

/* Whether bytes that came from outside are a memory that belongs to lists: every index in it means something. */
bool axcomp_memory_fits(const Lists *lists, const Memory *memory);

/* Compute the outputs of the first cycle without running it. */
void axcomp_preview_outputs(Instance *instance);

/* Run the cycles whose instants lie before `time`, s. */
fmi2Status axcomp_advance(Instance *instance, double time);

/* Whether the parameter cycle_time is possible. */
bool axcomp_cycle_time_fits(double cycle_time);

/* Free everything. */
void axcomp_free_instance(Instance *instance);

/* The instance, if a call is allowed in its phase; else NULL, after telling the host. */
Instance *axcomp_allowed(fmi2Component component, unsigned phases, const char *function);

/* The instance, if a pointer that a call needs is there; else NULL, after telling the host. */
Instance *axcomp_given(Instance *instance, const void *pointer, const char *function);

#ifdef __cplusplus
}
#endif

#endif
