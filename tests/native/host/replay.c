/* The commands of the host program that run whole simulations: one, many at once, and two in two threads. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
#include <pthread.h>
#endif

/* A trajectory as a file: seven counts (rows, then columns: real, Boolean and Integer inputs, real, Integer and Boolean outputs),
 * the references in this order, the step size, the rows: all inputs as doubles. */
typedef struct {
    uint32_t rows, reals, booleans, commands, results, integers, flags;
    uint32_t *references;
    double step;
    double *given;
} Trajectory;

static int read_trajectory(const char *path, Trajectory *t)
{
    uint32_t counts[7];
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        return 0;
    }
    int good = fread(counts, sizeof counts, 1, file) == 1;
    t->rows = counts[0], t->reals = counts[1], t->booleans = counts[2];
    t->commands = counts[3], t->results = counts[4], t->integers = counts[5], t->flags = counts[6];
    size_t references = (size_t)t->reals + t->booleans + t->commands + t->results + t->integers + t->flags;
    size_t numbers = (size_t)t->rows * (t->reals + t->booleans + t->commands);
    t->references = (uint32_t *)calloc(references + 1, sizeof(uint32_t));
    t->given = (double *)calloc(numbers + 1, sizeof(double));
    good = good && fread(t->references, sizeof(uint32_t), references, file) == references
        && fread(&t->step, sizeof(double), 1, file) == 1 && fread(t->given, sizeof(double), numbers, file) == numbers;
    fclose(file);
    return good;
}

/* Run the trajectory in an instance that steps; the outputs go into `results` as doubles. Returns 0 if all went well. */
static int run(fmi2Component instance, const Trajectory *t, double *results)
{
    const uint32_t *reals = t->references;
    const uint32_t *booleans = reals + t->reals;
    const uint32_t *commands = booleans + t->booleans;
    const uint32_t *wanted = commands + t->commands;
    const uint32_t *integers = wanted + t->results;
    const uint32_t *flags = integers + t->integers;
    const double *given = t->given;
    int *switches = (int *)calloc((size_t)t->booleans + t->commands + t->integers + t->flags + 1, sizeof(int));
    int failed = 0;
    for (uint32_t row = 0; row < t->rows; row++) {
        failed |= fmu.SetReal(instance, reals, t->reals, given) != fmi2OK;
        given += t->reals;
        for (uint32_t k = 0; k < t->booleans; k++) {
            switches[k] = *given++ != 0.0;
        }
        failed |= fmu.SetBoolean(instance, booleans, t->booleans, switches) != fmi2OK;
        for (uint32_t k = 0; k < t->commands; k++) {
            switches[k] = (int)*given++;
        }
        failed |= fmu.SetInteger(instance, commands, t->commands, switches) != fmi2OK;
        failed |= fmu.DoStep(instance, row * t->step, t->step, fmi2True) != fmi2OK;
        failed |= fmu.GetReal(instance, wanted, t->results, results) != fmi2OK;
        results += t->results;
        failed |= fmu.GetInteger(instance, integers, t->integers, switches) != fmi2OK;
        failed |= fmu.GetBoolean(instance, flags, t->flags, switches + t->integers) != fmi2OK;
        for (uint32_t k = 0; k < t->integers + t->flags; k++) {
            *results++ = switches[k];
        }
    }
    free(switches);
    return failed;
}

static size_t results_of(const Trajectory *t)
{
    return (size_t)t->rows * (t->results + t->integers + t->flags);
}

static int begin(fmi2Component instance)
{
    return fmu.SetupExperiment(instance, fmi2False, 0.0, 0.0, fmi2False, 0.0) != fmi2OK
        || fmu.EnterInitializationMode(instance) != fmi2OK || fmu.ExitInitializationMode(instance) != fmi2OK;
}

/* replay SLOT input output: a trajectory, in an instance just made; the results are written as doubles */
void replay(Slot *slot, char **words, int count)
{
    Trajectory t;
    (void)count;
    int failed = !read_trajectory(text_of(words[0]), &t);
    if (!failed) {
        double *results = (double *)calloc(results_of(&t) + 1, sizeof(double));
        failed = begin(slot->instance) || run(slot->instance, &t, results);
        FILE *file = fopen(text_of(words[1]), "wb");
        failed |= file == NULL || fwrite(results, sizeof(double), results_of(&t), file) != results_of(&t);
        failed |= file == NULL || fclose(file) != 0;
        free(results);
        free(t.references);
        free(t.given);
    }
    printf("= %d\n", failed);
}

static fmi2Component make(char **words, int number)
{
    char name[32];
    snprintf(name, sizeof name, "i%d", number);
    return fmu.Instantiate(name, fmi2CoSimulation, words[0], words[1], &HOST_CALLBACKS, fmi2False, fmi2False);
}

/* many number guid location input: so many instances at once, each running the trajectory; 1 if all results agree */
void many(Slot *slot, char **words, int count)
{
    Trajectory t;
    (void)slot, (void)count;
    int number = atoi(words[0]);
    text_of(words[1]), text_of(words[2]);
    int good = read_trajectory(text_of(words[3]), &t);
    fmi2Component *instances = (fmi2Component *)calloc((size_t)number, sizeof *instances);
    double *first = (double *)calloc(results_of(&t) + 1, sizeof(double));
    double *next = (double *)calloc(results_of(&t) + 1, sizeof(double));
    for (int i = 0; i < number; i++) {
        instances[i] = make(words + 1, i);
        good = good && instances[i] != NULL && !begin(instances[i]);
    }
    for (int i = 0; i < number; i++) {
        good = good && !run(instances[i], &t, i == 0 ? first : next);
        good = good && (i == 0 || memcmp(first, next, results_of(&t) * sizeof(double)) == 0);
    }
    for (int i = 0; i < number; i++) {
        fmu.FreeInstance(instances[i]);
    }
    free(instances);
    free(first);
    free(next);
    free(t.references);
    free(t.given);
    printf("= %d\n", good);
}

typedef struct {
    char **words;
    const Trajectory *trajectory;
    double *results;
    int good;
} Work;

enum { ROUNDS = 5 };

/* Make an instance, run it and free it, a few times over. */
static void work(Work *task)
{
    task->good = 1;
    for (int i = 0; i < ROUNDS; i++) {
        fmi2Component instance = make(task->words, i);
        task->good = task->good && instance != NULL && !begin(instance)
            && !run(instance, task->trajectory, task->results);
        fmu.FreeInstance(instance);
    }
}

#if defined(_WIN32)
static DWORD WINAPI work_in_thread(void *task)
{
    work((Work *)task);
    return 0;
}
#else
static void *work_in_thread(void *task)
{
    work((Work *)task);
    return NULL;
}
#endif

/* threads SLOT guid location input: two threads with an instance each at the same time; 1 if the results agree */
void threads(Slot *slot, char **words, int count)
{
    Trajectory t;
    Work tasks[2];
    (void)slot, (void)count;
    text_of(words[0]), text_of(words[1]);
    int good = read_trajectory(text_of(words[2]), &t);
    for (int i = 0; i < 2; i++) {
        tasks[i].words = words;
        tasks[i].trajectory = &t;
        tasks[i].results = (double *)calloc(results_of(&t) + 1, sizeof(double));
        tasks[i].good = 0;
    }
#if defined(_WIN32)
    HANDLE handles[2];
    for (int i = 0; i < 2; i++) {
        handles[i] = CreateThread(NULL, 0, work_in_thread, &tasks[i], 0, NULL);
    }
    WaitForMultipleObjects(2, handles, TRUE, INFINITE);
#else
    pthread_t handles[2];
    for (int i = 0; i < 2; i++) {
        good = good && pthread_create(&handles[i], NULL, work_in_thread, &tasks[i]) == 0;
    }
    for (int i = 0; i < 2; i++) {
        pthread_join(handles[i], NULL);
    }
#endif
    good = good && tasks[0].good && tasks[1].good;
    good = good && memcmp(tasks[0].results, tasks[1].results, results_of(&t) * sizeof(double)) == 0;
    free(tasks[0].results);
    free(tasks[1].results);
    free(t.references);
    free(t.given);
    printf("= %d\n", good);
}
