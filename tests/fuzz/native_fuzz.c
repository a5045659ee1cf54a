/* Random images, states and sequences of calls against the C layer, to be compiled with sanitizers.
 *
 *   native_fuzz images|states|calls COUNT SECONDS SEED FOLDER IMAGE...
 *
 * Images and states are altered and given a right checksum; what is accepted then runs, with inputs of every kind. The
 * program ends with 0 and says how much was tried; a sanitizer ends it otherwise. Each trial follows from its number:
 * SEED + k alone tries the k-th again. FOLDER gets the files that a reload reads. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2.h"
#include "instance.h"
#include "layout.h"
#include "memory.h"
#include "records.h"

/* What the FMU exports; its sources have no header for it. */
fmi2Component fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *, fmi2Boolean,
                              fmi2Boolean);
void fmi2FreeInstance(fmi2Component);
fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
fmi2Status fmi2EnterInitializationMode(fmi2Component);
fmi2Status fmi2ExitInitializationMode(fmi2Component);
fmi2Status fmi2Terminate(fmi2Component);
fmi2Status fmi2Reset(fmi2Component);
fmi2Status fmi2DoStep(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
fmi2Status fmi2GetReal(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
fmi2Status fmi2SetReal(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
fmi2Status fmi2GetInteger(fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]);
fmi2Status fmi2SetInteger(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Integer[]);
fmi2Status fmi2GetBoolean(fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]);
fmi2Status fmi2SetBoolean(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Boolean[]);
fmi2Status fmi2GetString(fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
fmi2Status fmi2SetString(fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]);
fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate *);
fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate *);
fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, size_t *);
fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *);

enum { IMAGES_MAX = 64, CYCLES = 8, REFERENCES = 64 * 64 };

typedef struct {
    unsigned char *data;
    size_t size;
} Bytes;

static Bytes seeds[IMAGES_MAX];
static int seed_count;
static const char *folder;
static unsigned long long rng;
static unsigned long long accepted;

static unsigned random_below(unsigned bound)
{
    rng ^= rng << 13;
    rng ^= rng >> 7;
    rng ^= rng << 17;
    return bound == 0 ? 0 : (unsigned)((rng >> 11) % bound);
}

static void seed_random(unsigned long long seed)
{
    rng = (seed + 1) * 0x9e3779b97f4a7c15ull;
    for (int i = 0; i < 4; i++) {
        random_below(2);
    }
}

static double odd_number(void)
{
    static const double numbers[] = {0.0, -0.0, 1.0, -1.0, 0.5, 1e-9, 1e-7, 1e-300, 1e5, 1e6, -1e6, 1e14, 1e15, -1e15, 1e16,
                                     1e20, 1e60, 1e300, -1e308, 359.9999, 360.0, 2147483647.0, 2147483648.0, 4294967296.0,
                                     NAN, INFINITY, -INFINITY};
    return numbers[random_below(sizeof numbers / sizeof numbers[0])];
}

static double any_number(void)
{
    return random_below(3) == 0 ? odd_number() : (double)random_below(2000000) * 0.0005 - 500.0;
}

static int32_t odd_int(void)
{
    static const int32_t numbers[] = {0, 1, -1, 2, 3, 4, 6, 7, 12, 20, 21, 31, 32, 33, 60, 71, 72, 73, 248, 249, 1000, 65536,
                                      INT32_MAX, INT32_MIN, INT32_MAX / 2, 1 << 30};
    return numbers[random_below(sizeof numbers / sizeof numbers[0])];
}

/* Choose a place, mostly near bytes that are not 0: most of the records is room that a machine does not use. */
static size_t place_in(const unsigned char *data, size_t size)
{
    size_t at = random_below((unsigned)size);
    for (int k = 0; k < 30 && random_below(8) != 0; k++) {
        size_t begin = at & ~(size_t)7, end = begin + 8 < size ? begin + 8 : size;
        for (size_t i = begin; i < end; i++) {
            if (data[i] != 0) {
                return at;
            }
        }
        at = random_below((unsigned)size);
    }
    return at;
}

/* Alter some places of bytes that hold records. */
static void alter(unsigned char *data, size_t size)
{
    int places = 1 + (int)random_below(random_below(4) == 0 ? 40 : 4);
    for (int k = 0; k < places && size >= 8; k++) {
        size_t at = place_in(data, size);
        switch (random_below(8)) {
        case 0:
            data[at] ^= (unsigned char)(1u << random_below(8));
            break;
        case 1:
            data[at] = (unsigned char)random_below(256);
            break;
        case 2:
        case 3: {
            int32_t number = odd_int();
            memcpy(data + (at & ~(size_t)3), &number, sizeof number);
            break;
        }
        case 4: {
            int32_t number;
            memcpy(&number, data + (at & ~(size_t)3), sizeof number);
            number = (int32_t)((uint32_t)number + random_below(7) - 3u);
            memcpy(data + (at & ~(size_t)3), &number, sizeof number);
            break;
        }
        case 5: {
            double number = odd_number();
            memcpy(data + ((at & ~(size_t)7) + 8 <= size ? at & ~(size_t)7 : 0), &number, sizeof number);
            break;
        }
        case 6: {
            double number;
            size_t place = (at & ~(size_t)7) + 8 <= size ? at & ~(size_t)7 : 0;
            memcpy(&number, data + place, sizeof number);
            number = random_below(2) ? -number : number * (random_below(2) ? 1e6 : 0.5);
            memcpy(data + place, &number, sizeof number);
            break;
        }
        default: {
            size_t from = random_below((unsigned)size), count = random_below(64);
            count = from + count > size ? size - from : count;
            count = at + count > size ? size - at : count;
            memmove(data + at, data + from, count);
        }
        }
    }
}

static uint32_t uint_at(const unsigned char *data, int bytes)
{
    uint32_t value = 0;
    for (int i = 0; i < bytes; i++) {
        value |= (uint32_t)data[i] << 8 * i;
    }
    return value;
}

static void put_uint(unsigned char *data, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        data[i] = (unsigned char)(value >> 8 * i);
    }
}

/* Bytes that the parts of a record before a field have in an image; `offset`: of the field, in memory. */
static size_t packed(const Part *part, size_t offset)
{
    size_t size = 0;
    for (; part->type != 0 && (size_t)part->offset < offset; part++) {
        size_t one = part->type == 'd' ? 8 : part->type == 'i' ? 4 : part->type == 'b' ? 1 : packed(part->parts, SIZE_MAX);
        size += one * (size_t)part->count;
    }
    return size;
}

enum { AXES_AT = 12, VOLUMETRICS_AT = 14, NUMBERS_AT = 16, CHECK_AT = 20, BODY = 24, GUID_AT = 24 };

/* Make an image that has the right length and checksum; to be freed. */
static Bytes altered_image(const Bytes *seed)
{
    Bytes image = {(unsigned char *)malloc(seed->size + 4096), seed->size};
    memcpy(image.data, seed->data, seed->size);
    uint32_t axes = uint_at(image.data + AXES_AT, 2), volumetrics = uint_at(image.data + VOLUMETRICS_AT, 2);
    uint32_t numbers = uint_at(image.data + NUMBERS_AT, 4);
    if (random_below(20) == 0 && numbers > 4) {
        /* Fewer numbers than the tables point to. */
        uint32_t fewer = 1 + random_below(random_below(2) ? 4 : numbers - 1);
        put_uint(image.data + NUMBERS_AT, numbers - fewer);
        image.size -= fewer * sizeof(double);
    }
    /* Tables are small beside their numbers: they get as many of the alterations. */
    size_t behind = HEADER_LENGTH + axes * (size_t)AXCOMP_AXIS_BYTES;
    size_t tables = behind + volumetrics * (size_t)AXCOMP_VOLUMETRIC_BYTES;
    if (random_below(3) == 0 && volumetrics > 0) {
        size_t blocks = packed(axcomp_volumetric_parts, offsetof(VolumetricTable, block));
        size_t some = packed(axcomp_volumetric_parts, offsetof(VolumetricTable, block) + 1u);
        some = blocks + 4u * (some - blocks) / ERRORS;
        unsigned char *one = image.data + behind + random_below(volumetrics) * (size_t)AXCOMP_VOLUMETRIC_BYTES;
        alter(one, random_below(2) ? blocks : some);
    } else if (random_below(3) != 0) {
        alter(image.data + HEADER_LENGTH + random_below(axes) * (size_t)AXCOMP_AXIS_BYTES, AXCOMP_AXIS_BYTES);
    } else if (random_below(2)) {
        alter(image.data + BODY, image.size - BODY);
    } else if (tables < image.size) {
        alter(image.data + tables, image.size - tables);
    }
    put_uint(image.data + CHECK_AT, axcomp_crc32(0, image.data + BODY, image.size - BODY));
    return image;
}

/* The example machines come first. */
static const Bytes *any_seed(void)
{
    return &seeds[random_below(random_below(2) && seed_count > 4 ? 4 : (unsigned)seed_count)];
}

static int32_t any_switch(void)
{
    return random_below(16) == 0 ? odd_int() : (int32_t)random_below(3) - 1;
}

static void give_inputs(const Tables *tables, Inputs *inputs)
{
    for (int i = 0; i < tables->axis_count; i++) {
        AxisInputs *given = &inputs->axis[i];
        given->setpoint = any_number();
        given->velocity = any_number();
        given->acceleration = any_number();
        given->actual_position = any_number();
        given->unreferenced = random_below(8) == 0;
        given->fault = random_below(16) == 0;
        given->no_move = random_below(4) == 0;
        given->released = random_below(8) == 0;
        for (int k = 0; k < KINDS; k++) {
            given->wanted[k] = any_switch();
        }
        given->compensation.temperature.offset = any_number();
        given->compensation.temperature.coefficient = any_number();
        given->compensation.friction.ahead_known = random_below(2) != 0;
        given->compensation.friction.velocity_ahead[random_below(LOOKAHEAD_MAX)] = any_number();
    }
    inputs->reset = random_below(16) == 0;
    inputs->program_end = random_below(16) == 0;
    inputs->derive_motion = random_below(4) == 0;
    inputs->tool_length = any_number();
    for (int k = 0; k < tables->volumetrics; k++) {
        inputs->volumetric[k].wanted = any_switch();
        inputs->volumetric[k].no_move = random_below(2) != 0;
        inputs->volumetric[k].reduction_x = any_number();
    }
}

static State state;
static Inputs inputs;
static Outputs outputs;

/* Arrays in blocks of their own, so that a sanitizer sees the end of each. */
static void give_arrays(const Shape *shape)
{
    size_t axes = (size_t)shape->axes, volumetrics = (size_t)shape->volumetrics;
    memset(&state, 0, sizeof state);
    memset(&inputs, 0, sizeof inputs);
    state.motion.axis = (AxisMotion *)calloc(axes, sizeof(AxisMotion));
    state.axis = (AxisState *)calloc(axes, sizeof(AxisState));
    state.volumetric = (VolumetricState *)calloc(volumetrics, sizeof(VolumetricState));
    inputs.axis = (AxisInputs *)calloc(axes, sizeof(AxisInputs));
    inputs.volumetric = (VolumetricInputs *)calloc(volumetrics, sizeof(VolumetricInputs));
    outputs.axis = (AxisOutputs *)calloc(axes, sizeof(AxisOutputs));
    outputs.volumetric = (VolumetricOutputs *)calloc(volumetrics, sizeof(VolumetricOutputs));
    for (size_t i = 0; i < axes; i++) {
        state.axis[i].compensation.friction.line = (double *)calloc((size_t)shape->lines[i], sizeof(double));
    }
}

static void free_arrays(State *of, Inputs *given, Outputs *returned, const Shape *shape)
{
    for (int32_t i = 0; i < shape->axes; i++) {
        free(of->axis[i].compensation.friction.line);
    }
    free(of->motion.axis);
    free(of->axis);
    free(of->volumetric);
    free(given->axis);
    free(given->volumetric);
    free(returned->axis);
    free(returned->volumetric);
}

static void run_cycles(const Lists *lists)
{
    for (int k = 0; k < CYCLES; k++) {
        give_inputs(&lists->tables, &inputs);
        axcomp_cycle(&lists->tables, lists->pool, &state, &inputs, &outputs);
    }
}

/* Go on with other tables of the same machine, if they fit; the shape becomes that of both. */
static void try_update(const Lists *now, Lists *next, Shape *shape)
{
    if (next->tables.axis_count != now->tables.axis_count || next->tables.volumetrics != now->tables.volumetrics) {
        return;
    }
    for (int i = 0; i < now->tables.axis_count; i++) {
        if (axcomp_update_error(&now->tables.axis[i], &next->tables.axis[i]) != 0) {
            return;
        }
    }
    Shape old = *shape, needed;
    State before = state;
    Inputs given = inputs;
    Outputs returned = outputs;
    axcomp_shape_of(&next->tables, &needed);
    for (int32_t i = 0; i < shape->axes; i++) {
        shape->lines[i] = needed.lines[i] > old.lines[i] ? needed.lines[i] : old.lines[i];
    }
    give_arrays(shape);
    axcomp_copy_state(&state, &before, &old);
    axcomp_copy_inputs(&inputs, &given, &old);
    axcomp_copy_outputs(&outputs, &returned, &old);
    free_arrays(&before, &given, &returned, &old);
    for (int i = 0; i < now->tables.axis_count; i++) {
        axcomp_adopt_axis(&now->tables.axis[i], now->pool, &next->tables.axis[i], next->pool, &state, &inputs.axis[i], i);
    }
    axcomp_adopt_volumetrics(&now->tables, &next->tables, &state, &outputs);
    run_cycles(next);
}

static void try_image(void)
{
    const Bytes *seed = any_seed();
    Bytes image = altered_image(seed);
    Lists *now = (Lists *)calloc(1, sizeof *now);
    const char *complaint = axcomp_read_image(image.data, image.size, now);
    free(image.data);
    if (complaint == NULL) {
        Shape shape;
        accepted++;
        axcomp_shape_of(&now->tables, &shape);
        give_arrays(&shape);
        run_cycles(now);
        if (random_below(4) == 0) {
            Bytes other = altered_image(seed);
            Lists *next = (Lists *)calloc(1, sizeof *next);
            if (axcomp_read_image(other.data, other.size, next) == NULL) {
                try_update(now, next, &shape);
            }
            axcomp_free_lists(next);
            free(other.data);
        }
        free_arrays(&state, &inputs, &outputs, &shape);
    }
    axcomp_free_lists(now);
}

static void silent(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment, (void)name, (void)status, (void)category, (void)message;
}

static const fmi2CallbackFunctions callbacks = {silent, calloc, free, NULL, NULL};

static void write_file(const char *name, Bytes bytes)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    if (file != NULL) {
        fwrite(bytes.data, 1, bytes.size, file);
        fclose(file);
    }
}

static fmi2Component new_instance(void)
{
    const Bytes *seed = &seeds[random_below((unsigned)seed_count)];
    write_file("tables.bin", *seed);
    return fmi2Instantiate("x", fmi2CoSimulation, (const char *)seed->data + GUID_AT, folder, &callbacks, fmi2False, fmi2True);
}

static void run_steps(fmi2Component component, double *time, int steps)
{
    Instance *instance = (Instance *)component;
    for (int k = 0; k < steps; k++) {
        give_inputs(&instance->lists->tables, &instance->memory.inputs);
        if (fmi2DoStep(component, *time, 0.001, fmi2True) == fmi2OK) {
            *time += 0.001;
        }
    }
}

/* A serialized state is a header, the memory, and the arrays. */
enum { HEAD = 8 + 6 * sizeof(uint32_t) };

static void try_state(void)
{
    static fmi2Component component;
    static Bytes bytes;
    static unsigned uses;
    if (component == NULL || uses++ % 500 == 0) {
        if (component != NULL) {
            fmi2FreeInstance(component);
        }
        free(bytes.data);
        component = new_instance();
        double time = 0.0;
        fmi2SetupExperiment(component, fmi2False, 0.0, 0.0, fmi2False, 0.0);
        fmi2EnterInitializationMode(component);
        fmi2ExitInitializationMode(component);
        run_steps(component, &time, 20);
        fmi2FMUstate saved = NULL;
        fmi2GetFMUstate(component, &saved);
        fmi2SerializedFMUstateSize(component, saved, &bytes.size);
        bytes.data = (unsigned char *)malloc(bytes.size);
        fmi2SerializeFMUstate(component, saved, (fmi2Byte *)bytes.data, bytes.size);
        fmi2FreeFMUstate(component, &saved);
    }
    unsigned char *copy = (unsigned char *)malloc(bytes.size);
    memcpy(copy, bytes.data, bytes.size);
    Instance *instance = (Instance *)component;
    const Tables *tables = &instance->lists->tables;
    Shape shape;
    axcomp_shape_of(tables, &shape);
    size_t size = axcomp_state_size(&shape) + 2u * axcomp_inputs_size(&shape) + axcomp_outputs_size(&shape);
    size_t arrays = bytes.size - size, axes = (size_t)shape.axes;
    if (random_below(3) != 0) {
        /* The motions and the first axis, or a volumetric compensation. */
        if (random_below(3) == 0 && shape.volumetrics > 0) {
            alter(copy + arrays + axes * (sizeof(AxisMotion) + sizeof(AxisState)), sizeof(VolumetricState));
        } else {
            alter(copy + arrays, axes * sizeof(AxisMotion) + sizeof(AxisState));
        }
    } else {
        alter(copy + HEAD, bytes.size - HEAD);
    }
    uint32_t check = axcomp_crc32(0, copy + 12, bytes.size - 12);
    memcpy(copy + 8, &check, sizeof check);
    fmi2FMUstate saved = NULL;
    if (fmi2DeSerializeFMUstate(component, (const fmi2Byte *)copy, bytes.size, &saved) == fmi2OK
        && fmi2SetFMUstate(component, saved) == fmi2OK) {
        accepted++;
        double time = instance->memory.start_time + instance->memory.cycles * instance->tables.cycle_time;
        instance->memory.phase = STEPPING;
        run_steps(component, &time, 6);
    }
    fmi2FreeFMUstate(component, &saved);
    free(copy);
}

static void try_calls(void)
{
    enum { STATES = 3 };
    fmi2Component component = new_instance();
    fmi2FMUstate states[STATES] = {NULL, NULL, NULL};
    double time = 0.0;
    for (int k = 0; k < 60 && component != NULL; k++) {
        fmi2ValueReference reference = random_below(3) ? random_below(5 * 64) : random_below(REFERENCES);
        fmi2FMUstate *one = &states[random_below(STATES)];
        fmi2Real real = any_number();
        fmi2Boolean boolean = (fmi2Boolean)random_below(3);
        fmi2Integer integer = odd_int();
        fmi2String text = NULL;
        switch (random_below(22)) {
        case 0: fmi2SetupExperiment(component, fmi2False, 0.0, random_below(4) ? 0.0 : real, fmi2False, 0.0); break;
        case 1: fmi2EnterInitializationMode(component); break;
        case 2: case 3: fmi2ExitInitializationMode(component); break;
        case 4: fmi2Terminate(component); break;
        case 5: if (random_below(4) == 0) { fmi2Reset(component); time = 0.0; } break;
        case 6: case 7: case 8: case 9:
            if (fmi2DoStep(component, time, random_below(8) ? 0.003 : fabs(real) < 1e3 ? fabs(real) * 1e-3 : real, boolean) == fmi2OK) { time += 0.003; }
            break;
        case 10: fmi2GetReal(component, &reference, 1, &real); break;
        case 11: case 12: fmi2SetReal(component, &reference, 1, &real); break;
        case 13: fmi2GetBoolean(component, &reference, 1, &boolean); break;
        case 14: fmi2SetBoolean(component, &reference, 1, &boolean); break;
        case 15: fmi2SetInteger(component, &reference, 1, &integer); fmi2GetInteger(component, &reference, 1, &integer); break;
        case 16: fmi2GetString(component, &reference, 1, &text); break;
        case 17: {
            fmi2ValueReference path = 3, reload = 2;
            char name[1024];
            Bytes image = altered_image(any_seed());
            write_file("new.bin", random_below(2) ? image : seeds[random_below((unsigned)seed_count)]);
            free(image.data);
            snprintf(name, sizeof name, "%s/%s", folder, random_below(8) ? "new.bin" : "");
            text = random_below(8) ? name : "";
            fmi2SetString(component, &path, 1, &text);
            boolean = random_below(4) != 0;
            fmi2SetBoolean(component, &reload, 1, &boolean);
            break;
        }
        case 18: fmi2GetFMUstate(component, one); break;
        case 19: if (*one != NULL) { fmi2SetFMUstate(component, *one); } break;
        case 20: fmi2FreeFMUstate(component, one); break;
        default:
            if (*one != NULL) {
                size_t size = 0;
                fmi2SerializedFMUstateSize(component, *one, &size);
                fmi2Byte *data = (fmi2Byte *)malloc(size);
                fmi2SerializeFMUstate(component, *one, data, size);
                fmi2FMUstate other = NULL;
                if (fmi2DeSerializeFMUstate(component, data, size, &other) != fmi2OK
                    || fmi2SetFMUstate(component, other) != fmi2OK) {
                    fprintf(stderr, "a state of the FMU's own is refused\n");
                    abort();
                }
                fmi2FreeFMUstate(component, &other);
                free(data);
            }
        }
    }
    for (int k = 0; k < STATES && component != NULL; k++) {
        fmi2FreeFMUstate(component, &states[k]);
    }
    fmi2FreeInstance(component);
}

int main(int count, char **words)
{
    if (count < 7) {
        return 2;
    }
    unsigned long long tries = strtoull(words[2], NULL, 10), seed = strtoull(words[4], NULL, 10), done = 0;
    double seconds = strtod(words[3], NULL);
    folder = words[5];
    for (int k = 6; k < count && seed_count < IMAGES_MAX; k++) {
        Bytes *image = &seeds[seed_count++];
        image->data = axcomp_read_file(words[k], &image->size);
        if (image->data == NULL) {
            return 2;
        }
    }
    void (*try_one)(void) = words[1][0] == 'i' ? try_image : words[1][0] == 's' ? try_state : try_calls;
    time_t end = time(NULL) + (time_t)seconds;
    for (; done < tries && (done % 64 != 0 || time(NULL) < end); done++) {
        if (getenv("AXCOMP_FUZZ_TELL") != NULL) {
            fprintf(stderr, "%llu\n", seed + done);
        }
        seed_random(seed + done);
        try_one();
    }
    printf("%llu %s, %llu accepted\n", done, words[1], accepted);
    return 0;
}
