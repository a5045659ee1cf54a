/* What a cycle costs in a C host: all inputs set, a step, all outputs read; of an FMU, and of the bare kernel.
 *
 *     bench fmu LIBRARY RESOURCES GUID PLAN BATCHES
 *     bench kernel IMAGE BATCHES [TRAVEL]
 *
 * With TRAVEL the axes go to and fro between ±490, so far in a cycle; 0: each cycle is somewhere else.
 * PLAN is a text: the step size in s; then for real inputs, Boolean inputs, real, Integer and Boolean outputs their
 * number and their value references, for Boolean inputs also their values. Prints for each batch the ns of a cycle. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#endif

#include "fmu_library.h"
#include "image.h"
#include "memory.h"
#include "resource.h"

enum { CYCLES = 2000, ROWS = 256, VARIABLES = 2048 };

typedef struct {
    unsigned count;
    fmi2ValueReference references[VARIABLES];
} Group;

typedef struct {
    double step;
    Group reals, booleans, commands, results, integers, flags;
} Plan;

/* ns of this process, so that others on the machine count little; on Windows, whose clock of processes is too coarse, of
 * the wall clock. */
static double now(void)
{
#if defined(_WIN32)
    LARGE_INTEGER ticks, frequency;
    QueryPerformanceFrequency(&frequency);
    QueryPerformanceCounter(&ticks);
    return 1e9 * (double)ticks.QuadPart / (double)frequency.QuadPart;
#else
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
#endif
}

/* The k-th real input in a row: everything moves smoothly, back and forth, at up to 0.25 mm in a cycle as machines do. */
static double motion(unsigned row, unsigned k)
{
    return 10.0 * sin(6.283185307179586 * row / ROWS + k);
}

static int read_group(FILE *file, Group *group)
{
    if (fscanf(file, "%u", &group->count) != 1 || group->count > VARIABLES) {
        return 0;
    }
    for (unsigned k = 0; k < group->count; k++) {
        if (fscanf(file, "%u", &group->references[k]) != 1) {
            return 0;
        }
    }
    return 1;
}

static int read_plan(const char *path, Plan *plan)
{
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return 0;
    }
    int good = fscanf(file, "%lf", &plan->step) == 1 && read_group(file, &plan->reals)
        && read_group(file, &plan->booleans) && read_group(file, &plan->commands) && read_group(file, &plan->results)
        && read_group(file, &plan->integers) && read_group(file, &plan->flags);
    fclose(file);
    return good;
}

static void on_log(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static int bench_fmu(const Fmu *fmu, const char *resources, const char *guid, const Plan *plan, int batches)
{
    static double reals[ROWS][VARIABLES], results[VARIABLES];
    static fmi2Integer integers[VARIABLES], flags[VARIABLES], nothing[VARIABLES];
    const fmi2CallbackFunctions callbacks = {on_log, calloc, free, NULL, NULL};
    fmi2Component c = fmu->Instantiate("bench", fmi2CoSimulation, guid, resources, &callbacks, fmi2False, fmi2False);
    if (c == NULL || fmu->EnterInitializationMode(c) != fmi2OK || fmu->ExitInitializationMode(c) != fmi2OK) {
        return 1;
    }
    for (unsigned row = 0; row < ROWS; row++) {
        for (unsigned k = 0; k < plan->reals.count; k++) {
            reals[row][k] = motion(row, k);
        }
    }
    double time = 0.0;
    int status = fmi2OK;
    for (int batch = 0; batch < batches; batch++) {
        double begin = now();
        for (int cycle = 0; cycle < CYCLES; cycle++) {
            status |= fmu->SetReal(c, plan->reals.references, plan->reals.count, reals[cycle % ROWS]);
            status |= fmu->SetBoolean(c, plan->booleans.references, plan->booleans.count, nothing);
            status |= fmu->SetInteger(c, plan->commands.references, plan->commands.count, nothing);
            status |= fmu->DoStep(c, time, plan->step, fmi2True);
            time += plan->step;
            status |= fmu->GetReal(c, plan->results.references, plan->results.count, results);
            status |= fmu->GetInteger(c, plan->integers.references, plan->integers.count, integers);
            status |= fmu->GetBoolean(c, plan->flags.references, plan->flags.count, flags);
        }
        printf("%.3f\n", (now() - begin) / CYCLES);
    }
    fmu->FreeInstance(c);
    return status != fmi2OK;
}

/* Let every axis go on: so far in a cycle, or to any place. */
static void travel_on(const Tables *tables, Inputs *inputs, double travel)
{
    static uint64_t drawn = 88172645463325252u;
    static bool back[AXES];
    for (int i = 0; i < tables->axis_count; i++) {
        AxisInputs *axis = &inputs->axis[i];
        if (travel > 0.0) {
            back[i] = axis->setpoint > 490.0 || (back[i] && axis->setpoint > -490.0);
            axis->setpoint += back[i] ? -travel : travel;
            axis->velocity = (back[i] ? -travel : travel) / tables->cycle_time;
        } else {
            drawn ^= drawn << 13;
            drawn ^= drawn >> 7;
            drawn ^= drawn << 17;
            axis->setpoint = 980.0 * (double)(drawn >> 11) / 9007199254740992.0 - 490.0;
            axis->velocity = axis->setpoint;
        }
    }
}

static int bench_kernel(const char *image, int batches, double travel)
{
    static Lists lists;
    static State state;
    static Inputs rows[ROWS];
    static Outputs outputs;
    size_t size = 0;
    unsigned char *data = axcomp_read_file(image, &size);
    if (data == NULL || axcomp_read_image(data, size, &lists) != NULL) {
        return 1;
    }
    Shape shape;
    axcomp_shape_of(&lists.tables, &shape);
    void *remembered = calloc(1, axcomp_state_size(&shape)), *returned = calloc(1, axcomp_outputs_size(&shape));
    char *given = (char *)calloc(ROWS, axcomp_inputs_size(&shape));
    if (remembered == NULL || returned == NULL || given == NULL) {
        return 1;
    }
    axcomp_place_state(&state, remembered, &shape);
    axcomp_place_outputs(&outputs, returned, &shape);
    for (unsigned row = 0; row < ROWS; row++) {
        axcomp_place_inputs(&rows[row], given + row * axcomp_inputs_size(&shape), &shape);
        /* The same numbers as for an FMU whose real inputs are these four of each axis. */
        for (int i = 0; i < lists.tables.axis_count; i++) {
            AxisInputs *axis = &rows[row].axis[i];
            unsigned k = 4u * (unsigned)i;
            axis->setpoint = motion(row, k);
            axis->velocity = motion(row, k + 1);
            axis->acceleration = motion(row, k + 2);
            axis->actual_position = motion(row, k + 3);
        }
    }
    for (int batch = 0; batch < batches; batch++) {
        double begin = now();
        for (int cycle = 0; cycle < CYCLES; cycle++) {
            if (travel < 0.0) {
                axcomp_cycle(&lists.tables, lists.pool, &state, &rows[cycle % ROWS], &outputs);
            } else {
                travel_on(&lists.tables, &rows[0], travel);
                axcomp_cycle(&lists.tables, lists.pool, &state, &rows[0], &outputs);
            }
        }
        printf("%.3f\n", (now() - begin) / CYCLES);
    }
    free(remembered), free(returned), free(given);
    free((void *)lists.pool), free(lists.tables.axis), free(lists.tables.volumetric);
    free(data);
    return 0;
}

int main(int count, char **arguments)
{
    static Plan plan;
    Fmu fmu;
    if (count == 7 && strcmp(arguments[1], "fmu") == 0 && read_plan(arguments[5], &plan)) {
        const char *missing = load_fmu(arguments[2], &fmu);
        if (missing != NULL && missing[0] == 0) {
            fprintf(stderr, "%s cannot be loaded\n", arguments[2]);
            return 1;
        }
        return bench_fmu(&fmu, arguments[3], arguments[4], &plan, atoi(arguments[6]));
    }
    if ((count == 4 || count == 5) && strcmp(arguments[1], "kernel") == 0) {
        return bench_kernel(arguments[2], atoi(arguments[3]), count == 5 ? atof(arguments[4]) : -1.0);
    }
    fputs("usage: bench fmu LIBRARY RESOURCES GUID PLAN BATCHES | bench kernel IMAGE BATCHES [TRAVEL]\n", stderr);
    return 2;
}
