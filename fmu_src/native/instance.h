/* One instance of the FMU: tables, everything that changes, and what the host has said about logging. */
#ifndef AXCOMP_INSTANCE_H
#define AXCOMP_INSTANCE_H

#include <stdbool.h>

#include "fmi2.h"
#include "image.h"
#include "memory.h"

#if defined(AXCOMP_EMBEDDED)
enum { PATH_LENGTH = 256 };  /* a path is of no use here: there are no files */
#else
#include "resource.h"
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Where the instance is in the state machine of FMI 2.0 (section 4.2.4), or 3.0, which has event mode too; bits, so that
 * calls can name several. */
typedef enum { INSTANTIATED = 1, INITIALIZATION = 2, STEPPING = 4, TERMINATED = 8, EVENT = 16 } Phase;

/* The variables that the kernel does not know. */
typedef struct {
    double cycle_time;
    int32_t largest_step;  /* in cycles */
    bool reload;
    char update_path[PATH_LENGTH];  /* last of all: a saved state has only as much of it as is used */
} Controls;

/* Everything that changes, besides the arrays of the records. */
typedef struct {
    State state;
    Inputs inputs;
    Outputs outputs;
    Inputs slopes;      /* derivatives of the Real inputs, where these are in `inputs`; for the next step */
    bool sloped;        /* one of them has been set */
    double start_time;  /* s */
    double stop_time;   /* s; infinite: none is known */
    double time;        /* where the last step ended, s */
    double cycles;      /* run so far */
    Phase phase;
    bool reload_seen;   /* `reload` was on in the last step: there is no edge until it has been off */
    bool refused;       /* the update that waits for the next step was refused */
    Controls controls;
} Memory;

typedef struct {
    fmi2CallbackFunctions callbacks;
    const Lists *first;   /* those of this FMU */
    const Lists *lists;   /* in force */
    Tables tables;        /* theirs, with the cycle time that the host has set */
    Shape shape;          /* of the arrays */
    Memory memory;
    Inputs begin;         /* those at the begin of a step whose inputs have a slope */
    State preview;        /* of the cycle that is computed during initialization, without being run */
    uint32_t told[KINDS + 1]; /* bit i: that a kind of axis i was used beyond its table; the last: a switch was none */
    void *block;          /* the arrays of `memory`, `begin` and `preview` */
    void (*log)(void);    /* fmi3LogMessageCallback of a host that speaks FMI 3.0, else NULL */
    bool event_mode;      /* such a host uses event mode */
    bool stale;           /* in event mode: the outputs do not belong to the inputs yet */
#if !defined(AXCOMP_EMBEDDED)
    Lists *own;           /* that were read by `reload` and that a saved state may come back to */
    Lists *waiting;       /* of these: for the next step; NULL: none */
    bool logging;
    unsigned categories;  /* bit k: category k of axcomp_log_categories */
    char *name;
    char own_path[PATH_LENGTH];  /* of the image that belongs to this FMU */
#endif
} Instance;

enum { CATEGORY_WARNING, CATEGORY_ERROR, CATEGORY_ALL, CATEGORIES };
extern const char *const axcomp_log_categories[CATEGORIES];

/* Tell the host; errors always, the rest if it wants to know. Returns `status`. */
fmi2Status axcomp_say(const Instance *instance, fmi2Status status, const char *format, ...);

/* What the host wants to be told from now on; `categories`: bit k: category k of axcomp_log_categories. */
void axcomp_log_as_wanted(Instance *instance, bool on, unsigned categories);


/* Make an instance that has neither tables nor arrays yet; NULL: there is no memory. */
Instance *axcomp_new_instance(const char *name);

/* Give a new instance its tables and put it at its begin. Returns it, or NULL after telling the host why it is freed. */
Instance *axcomp_begin_instance(Instance *instance, const char *name, const char *guid, const char *location);

/* Give the instance arrays as large as its shape. Returns whether there is memory. */
bool axcomp_give_arrays(Instance *instance);

/* Let the records of the instance point into its block, and the bytes of this. */
void axcomp_place_arrays(Instance *instance);
size_t axcomp_block_size(const Shape *shape);

/* Copy the arrays of all records, each into its own; `shape`: that of the smaller ones. */
void axcomp_copy_arrays(Memory *to, const Memory *from, const Shape *shape);

/* Free everything. */
void axcomp_free_instance(Instance *instance);

/* A copy of the lists in force, to be changed, which the instance owns; NULL: there is no memory. */
Lists *axcomp_copy_lists(Instance *instance);

/* Give up the last copy, which never came into force. */
void axcomp_drop_lists(Instance *instance, Lists *copy);

/* Memory for a saved state, all 0; NULL: there is none. */
void *axcomp_new_state(size_t size);
void axcomp_free_state(void *state);

/* Put the instance back to what it is right after instantiation. */
void axcomp_begin_again(Instance *instance);

/* Look at `reload` and `update_path`, of which one has been set. On a rising edge the image is read (an empty path: the
 * FMU's own one); the next step takes or refuses it. `path_set`: what was read before may be another one. */
void axcomp_watch_reload(Instance *instance, bool path_set);

/* Take the lists that wait, or tell by the outputs that they were refused. */
void axcomp_take_update(Instance *instance);

/* Lists that the next step takes, NULL: none. To wait for some may need memory; returns whether there is so much. */
const Lists *axcomp_waiting_lists(const Instance *instance);
bool axcomp_wait_for(Instance *instance, const Lists *lists);

/* The tables that belong to this FMU; NULL after telling the host why there are none. */
const Lists *axcomp_own_lists(Instance *instance, fmi2String location);

/* The instance's lists with an identity, NULL if it has none. */
const Lists *axcomp_lists_with(const Instance *instance, uint32_t identity);

/* Let lists be in force, with the cycle time that is set. */
void axcomp_use_lists(Instance *instance, const Lists *lists);

/* Note that a state in memory refers to lists (`by` 1), or no longer does (-1). */
void axcomp_hold_lists(Instance *instance, uint32_t identity, int by);

/* Free lists that nothing uses, but for the last ones: a state in bytes may come back to them. */
void axcomp_forget_lists(Instance *instance);

/* Whether bytes that came from outside are a memory that belongs to lists: every index in it means something. */
bool axcomp_memory_fits(const Lists *lists, const Memory *memory);

/* Compute the outputs of the first cycle without running it. */
void axcomp_preview_outputs(Instance *instance);

/* Whether a cycle begins where the last step ended. */
bool axcomp_cycle_begins(const Instance *instance);

/* In event mode: compute the outputs that belong to the inputs of this instant, if it is one of a cycle. */
void axcomp_refresh_outputs(Instance *instance);

/* Make a step from `begin` to `end`, s: run the cycles whose instants lie before its end and have not been run. */
fmi2Status axcomp_advance(Instance *instance, double begin, double end);

/* Round to nearest, whatever the host does; what it did is to be restored. */
int axcomp_round_to_nearest(void);
void axcomp_restore_rounding(int mode);

/* Whether the parameter cycle_time is possible. */
bool axcomp_cycle_time_fits(double cycle_time);

/* The instance, if a call is allowed in its phase; else NULL, after telling the host. */
Instance *axcomp_allowed(fmi2Component component, unsigned phases, const char *function);

/* The instance, if a pointer that a call needs is there; else NULL, after telling the host. */
Instance *axcomp_given(Instance *instance, const void *pointer, const char *function);

#ifdef __cplusplus
}
#endif

#endif
