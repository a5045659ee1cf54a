/* The commands of the host program that are one call of FMI each. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "host.h"

enum { VALUES = 2048 };

static void answer(fmi2Status status)
{
    printf("= %d\n", (int)status);
}

/* instantiate SLOT name type guid location callbacks(0, 1: with a logger, 2: without one) logging */
static void instantiate(Slot *slot, char **words, int count)
{
    static const fmi2CallbackFunctions SILENT = {NULL, NULL, NULL, NULL, NULL};
    (void)count;
    const fmi2CallbackFunctions *callbacks[] = {NULL, &HOST_CALLBACKS, &SILENT};
    slot->instance = fmu.Instantiate(text_of(words[0]), (fmi2Type)atoi(words[1]), text_of(words[2]), text_of(words[3]),
                                     callbacks[atoi(words[4])], fmi2False, atoi(words[5]));
    printf("= %d\n", slot->instance != NULL);
}

static void free_instance(Slot *slot, char **words, int count)
{
    (void)words, (void)count;
    fmu.FreeInstance(slot->instance);
    slot->instance = NULL;
    answer(fmi2OK);
}

static void debug(Slot *slot, char **words, int count)
{
    const char *categories[16];
    for (int i = 0; i < count - 1 && i < 16; i++) {
        categories[i] = text_of(words[i + 1]);
    }
    answer(fmu.SetDebugLogging(slot->instance, atoi(words[0]), (size_t)(count > 1 ? count - 1 : 0), categories));
}

static void setup(Slot *slot, char **words, int count)
{
    (void)count;
    answer(fmu.SetupExperiment(slot->instance, atoi(words[0]), real_of(words[1]), real_of(words[2]), atoi(words[3]),
                               real_of(words[4])));
}

#define WITHOUT_ARGUMENTS(NAME, FUNCTION)                                                                              \
    static void NAME(Slot *slot, char **words, int count)                                                              \
    {                                                                                                                  \
        (void)words, (void)count;                                                                                      \
        answer(fmu.FUNCTION(slot->instance));                                                                          \
    }

WITHOUT_ARGUMENTS(enter, EnterInitializationMode)
WITHOUT_ARGUMENTS(leave, ExitInitializationMode)
WITHOUT_ARGUMENTS(terminate, Terminate)
WITHOUT_ARGUMENTS(reset, Reset)

static void step(Slot *slot, char **words, int count)
{
    (void)count;
    answer(fmu.DoStep(slot->instance, real_of(words[0]), real_of(words[1]), fmi2True));
}

/* get SLOT r|i|b|s references… */
static void get(Slot *slot, char **words, int count)
{
    fmi2ValueReference references[VALUES];
    union {
        double r[VALUES];
        int i[VALUES];
        const char *s[VALUES];
    } values;
    size_t number = (size_t)(count > 1 ? count - 1 : 0);
    fmi2Status status = fmi2OK;
    char type = words[0][0];
    for (size_t k = 0; k < number; k++) {
        references[k] = (fmi2ValueReference)strtoul(words[k + 1], NULL, 10);
    }
    if (type == 'r') {
        status = fmu.GetReal(slot->instance, references, number, values.r);
    } else if (type == 'i') {
        status = fmu.GetInteger(slot->instance, references, number, values.i);
    } else if (type == 'b') {
        status = fmu.GetBoolean(slot->instance, references, number, values.i);
    } else {
        status = fmu.GetString(slot->instance, references, number, values.s);
    }
    printf("= %d", (int)status);
    for (size_t k = 0; status == fmi2OK && k < number; k++) {
        if (type == 'r') {
            print_real(values.r[k]);
        } else if (type == 's') {
            printf(" <%s>", values.s[k]);
        } else {
            printf(" %d", values.i[k]);
        }
    }
    printf("\n");
}

/* set SLOT r|i|b|s reference value reference value … */
static void set(Slot *slot, char **words, int count)
{
    fmi2ValueReference references[VALUES];
    double reals[VALUES];
    int integers[VALUES];
    const char *strings[VALUES];
    size_t number = (size_t)(count > 1 ? (count - 1) / 2 : 0);
    fmi2Status status = fmi2OK;
    char type = words[0][0];
    for (size_t k = 0; k < number; k++) {
        references[k] = (fmi2ValueReference)strtoul(words[2 * k + 1], NULL, 10);
        char *value = words[2 * k + 2];
        reals[k] = type == 'r' ? real_of(value) : 0.0;
        integers[k] = atoi(value);
        strings[k] = text_of(value);
    }
    if (type == 'r') {
        status = fmu.SetReal(slot->instance, references, number, reals);
    } else if (type == 'i') {
        status = fmu.SetInteger(slot->instance, references, number, integers);
    } else if (type == 'b') {
        status = fmu.SetBoolean(slot->instance, references, number, integers);
    } else {
        status = fmu.SetString(slot->instance, references, number, strings);
    }
    answer(status);
}

/* nulls SLOT: arrays and pointers that are not there, in every function that takes some; 1 if all but those that the
 * standard allows say error */
static void nulls(Slot *slot, char **words, int count)
{
    (void)words, (void)count;
    fmi2Component c = slot->instance;
    const fmi2ValueReference reference = 64;
    double real = 0.0;
    const fmi2Status wrong[] = {
        fmu.GetReal(c, NULL, 1, &real),         fmu.GetReal(c, &reference, 1, NULL),    fmu.GetInteger(c, NULL, 1, NULL),
        fmu.GetBoolean(c, NULL, 1, NULL),       fmu.GetString(c, NULL, 1, NULL),        fmu.SetReal(c, NULL, 1, &real),
        fmu.SetReal(c, &reference, 1, NULL),    fmu.SetInteger(c, NULL, 1, NULL),       fmu.SetBoolean(c, NULL, 1, NULL),
        fmu.SetString(c, NULL, 1, NULL),        fmu.GetFMUstate(c, NULL),               fmu.SetFMUstate(c, NULL),
        fmu.SerializedFMUstateSize(c, NULL, NULL), fmu.SerializeFMUstate(c, NULL, NULL, 0),
        fmu.DeSerializeFMUstate(c, NULL, 0, NULL), fmu.SetDebugLogging(c, 1, 1, NULL),
        fmu.GetDirectionalDerivative(c, NULL, 0, NULL, 0, NULL, NULL), fmu.CancelStep(c),
        fmu.SetRealInputDerivatives(c, NULL, 1, NULL, NULL), fmu.GetRealOutputDerivatives(c, NULL, 1, NULL, NULL),
        fmu.EnterEventMode(c),                  fmu.NewDiscreteStates(c, NULL),         fmu.EnterContinuousTimeMode(c),
        fmu.CompletedIntegratorStep(c, 0, NULL, NULL), fmu.SetTime(c, 0.0),             fmu.SetContinuousStates(c, NULL, 0),
        fmu.GetDerivatives(c, NULL, 0),         fmu.GetEventIndicators(c, NULL, 0),     fmu.GetContinuousStates(c, NULL, 0),
        fmu.GetNominalsOfContinuousStates(c, NULL, 0),
    };
    int refused = 1;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        refused = refused && wrong[i] == fmi2Error;
    }
    /* Nothing is pending, ever: discard, or error without an instance. */
    const fmi2Status nothing[] = {
        fmu.GetStatus(c, fmi2DoStepStatus, NULL),           fmu.GetRealStatus(c, fmi2LastSuccessfulTime, NULL),
        fmu.GetIntegerStatus(c, fmi2DoStepStatus, NULL),    fmu.GetBooleanStatus(c, fmi2Terminated, NULL),
        fmu.GetStringStatus(c, fmi2PendingStatus, NULL),
    };
    for (size_t i = 0; i < sizeof nothing / sizeof nothing[0]; i++) {
        refused = refused && (nothing[i] == (c == NULL ? fmi2Error : fmi2Discard));
    }
    /* The standard allows to free no state, and no instance. */
    fmi2FMUstate none = NULL;
    refused = refused && (c == NULL || (fmu.FreeFMUstate(c, NULL) == fmi2OK && fmu.FreeFMUstate(c, &none) == fmi2OK));
    fmu.FreeInstance(NULL);
    printf("= %d\n", refused);
}

/* save SLOT other: the state of SLOT's instance goes into the slot `other`, over what is there */
static void save(Slot *slot, char **words, int count)
{
    (void)count;
    answer(fmu.GetFMUstate(slot->instance, &slots[atoi(words[0])].state));
}

/* restore SLOT other */
static void restore(Slot *slot, char **words, int count)
{
    (void)count;
    answer(fmu.SetFMUstate(slot->instance, slots[atoi(words[0])].state));
}

/* release SLOT other */
static void release(Slot *slot, char **words, int count)
{
    (void)count;
    fmi2Status status = fmu.FreeFMUstate(slot->instance, &slots[atoi(words[0])].state);
    printf("= %d %d\n", (int)status, slots[atoi(words[0])].state == NULL);
}

/* serialize SLOT other short: into as many bytes less than the state has */
static void serialize(Slot *slot, char **words, int count)
{
    (void)count;
    Slot *other = &slots[atoi(words[0])];
    size_t size = 0;
    fmi2Status status = fmu.SerializedFMUstateSize(slot->instance, other->state, &size);
    if (status == fmi2OK) {
        free(other->bytes);
        other->size = size - (size_t)atoi(words[1]);
        other->bytes = (char *)malloc(other->size);
        status = fmu.SerializeFMUstate(slot->instance, other->state, other->bytes, other->size);
    }
    printf("= %d %zu\n", (int)status, size);
}

/* deserialize SLOT other size place: as many of its bytes (0: all), the one at `place` altered (negative: none) */
static void deserialize(Slot *slot, char **words, int count)
{
    (void)count;
    Slot *other = &slots[atoi(words[0])];
    size_t size = atoi(words[1]) == 0 ? other->size : (size_t)atoi(words[1]);
    int place = atoi(words[2]);
    char *bytes = (char *)malloc(size + 1);
    fmi2FMUstate state = NULL;
    memset(bytes, 0, size + 1);
    if (other->bytes != NULL) {
        memcpy(bytes, other->bytes, size < other->size ? size : other->size);
    }
    if (place >= 0 && (size_t)place < size) {
        bytes[place] = (char)(bytes[place] ^ 0x10);
    }
    fmi2Status status = fmu.DeSerializeFMUstate(slot->instance, bytes, size, &state);
    free(bytes);
    if (status == fmi2OK) {
        fmu.FreeFMUstate(slot->instance, &other->state);
        other->state = state;
    }
    answer(status);
}

/* keep SLOT file, fetch SLOT file: the bytes of a serialized state */
static void keep(Slot *slot, char **words, int count)
{
    (void)count;
    FILE *file = fopen(text_of(words[0]), "wb");
    size_t written = file == NULL ? 0 : fwrite(slot->bytes, 1, slot->size, file);
    if (file != NULL) {
        fclose(file);
    }
    printf("= %d\n", written != slot->size);
}

static void fetch(Slot *slot, char **words, int count)
{
    (void)count;
    FILE *file = fopen(text_of(words[0]), "rb");
    if (file != NULL) {
        free(slot->bytes);
        fseek(file, 0, SEEK_END);
        slot->size = (size_t)ftell(file);
        rewind(file);
        slot->bytes = (char *)malloc(slot->size + 1);
        slot->size = fread(slot->bytes, 1, slot->size, file);
        fclose(file);
    }
    printf("= %d\n", file == NULL);
}

static void about(Slot *slot, char **words, int count)
{
    (void)slot, (void)words, (void)count;
    printf("= 0 %s %s\n", fmu.GetTypesPlatform(), fmu.GetVersion());
}

const Command COMMANDS[] = {
    {"instantiate", instantiate},
    {"free", free_instance},
    {"debug", debug},
    {"setup", setup},
    {"enter", enter},
    {"exit", leave},
    {"terminate", terminate},
    {"reset", reset},
    {"step", step},
    {"get", get},
    {"set", set},
    {"nulls", nulls},
    {"save", save},
    {"restore", restore},
    {"release", release},
    {"serialize", serialize},
    {"deserialize", deserialize},
    {"keep", keep},
    {"fetch", fetch},
    {"about", about},
    {"replay", replay},
    {"many", many},
    {"threads", threads},
    {NULL, NULL},
};
