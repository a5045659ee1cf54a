/* FMI 2.0 for co-simulation, types and functions (sections 2.1 and 4.2).
 *
 * An importer that compiles these sources has headers of its own: with fmi2Functions.h it says how functions are called.
 * Where there is none, what they need stands here. */
#ifndef AXCOMP_FMI2_H
#define AXCOMP_FMI2_H

#include <stddef.h>

#include "config.h"

#if defined(__has_include)
#if __has_include("fmi2Functions.h")
#define AXCOMP_IMPORTERS_HEADER
#endif
#endif

#if defined(AXCOMP_IMPORTERS_HEADER)
#include "fmi2Functions.h"
#define FMI2_NAME(name) name
#if defined(__cplusplus)
#define FMI2_EXPORT extern "C" FMI2_Export
#else
#define FMI2_EXPORT FMI2_Export
#endif
#else

#define fmi2TypesPlatform "default"
#define fmi2Version "2.0"
#define fmi2True 1
#define fmi2False 0

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char *fmi2String;
typedef char fmi2Byte;

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category,
                                   fmi2String message, ...);
typedef void *(*fmi2CallbackAllocateMemory)(size_t count, size_t size);
typedef void (*fmi2CallbackFreeMemory)(void *);
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment, fmi2Status);

typedef struct {
    fmi2CallbackLogger logger;
    fmi2CallbackAllocateMemory allocateMemory;
    fmi2CallbackFreeMemory freeMemory;
    fmi2StepFinished stepFinished;
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded;
    fmi2Boolean terminateSimulation;
    fmi2Boolean nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged;
    fmi2Boolean nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

/* What is linked statically has the model's name before every function; in a shared library there is no prefix. */
#if defined(FMI2_FUNCTION_PREFIX) && !defined(FMI2_OVERRIDE_FUNCTION_PREFIX)
#define FMI2_PASTE(a, b) a##b
#define FMI2_PASTE_EXPANDED(a, b) FMI2_PASTE(a, b)
#define FMI2_NAME(name) FMI2_PASTE_EXPANDED(FMI2_FUNCTION_PREFIX, name)
#else
#define FMI2_NAME(name) name
#endif

#if defined(__cplusplus)
#define FMI2_LINKAGE extern "C"
#else
#define FMI2_LINKAGE
#endif

#if defined(_WIN32)
#define FMI2_EXPORT FMI2_LINKAGE __declspec(dllexport)
#elif defined(__GNUC__)
#define FMI2_EXPORT FMI2_LINKAGE __attribute__((visibility("default")))
#else
#define FMI2_EXPORT FMI2_LINKAGE
#endif

#endif

#endif
