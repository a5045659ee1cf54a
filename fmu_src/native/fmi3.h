/* FMI 3.0 for co-simulation: the types that its functions here need (sections 2.2 and 4.2).
 *
 * As fmi2.h: an importer that compiles these sources has headers of its own. */
#ifndef AXCOMP_FMI3_H
#define AXCOMP_FMI3_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "fmi2.h"

#if defined(__has_include)
#if __has_include("fmi3Functions.h")
#define AXCOMP_IMPORTERS_FMI3
#endif
#endif

#if defined(AXCOMP_IMPORTERS_FMI3)
#include "fmi3Functions.h"
#define FMI3_NAME(name) name
#if defined(__cplusplus)
#define FMI3_EXPORT extern "C" FMI3_Export
#else
#define FMI3_EXPORT FMI3_Export
#endif
#else

typedef void *fmi3Instance;
typedef void *fmi3InstanceEnvironment;
typedef void *fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;
typedef bool fmi3Clock;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum { fmi3Independent, fmi3Constant, fmi3Fixed, fmi3Tunable, fmi3Discrete, fmi3Dependent } fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category, fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean, fmi3Boolean *, fmi3Float64 *);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

#if defined(FMI3_FUNCTION_PREFIX) && !defined(FMI3_OVERRIDE_FUNCTION_PREFIX)
#define FMI3_PASTE(a, b) a##b
#define FMI3_PASTE_EXPANDED(a, b) FMI3_PASTE(a, b)
#define FMI3_NAME(name) FMI3_PASTE_EXPANDED(FMI3_FUNCTION_PREFIX, name)
#else
#define FMI3_NAME(name) name
#endif
#define FMI3_EXPORT FMI2_EXPORT

#endif

/* The functions of FMI 2.0 that those of FMI 3.0 go on to; the numbers of their statuses are the same. */
#if !defined(AXCOMP_IMPORTERS_HEADER)
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetDebugLogging)(fmi2Component, fmi2Boolean, size_t, const fmi2String[]);
FMI2_EXPORT void FMI2_NAME(fmi2FreeInstance)(fmi2Component);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetupExperiment)(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean,
                                                      fmi2Real);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2EnterInitializationMode)(fmi2Component);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2ExitInitializationMode)(fmi2Component);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2Reset)(fmi2Component);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DoStep)(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetReal)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Real[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetInteger)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Integer[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetBoolean)(fmi2Component, const fmi2ValueReference[], size_t, fmi2Boolean[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetString)(fmi2Component, const fmi2ValueReference[], size_t, fmi2String[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetReal)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2Real[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetInteger)(fmi2Component, const fmi2ValueReference[], size_t,
                                                 const fmi2Integer[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetBoolean)(fmi2Component, const fmi2ValueReference[], size_t,
                                                 const fmi2Boolean[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetString)(fmi2Component, const fmi2ValueReference[], size_t, const fmi2String[]);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2GetFMUstate)(fmi2Component, fmi2FMUstate *);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SetFMUstate)(fmi2Component, fmi2FMUstate);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2FreeFMUstate)(fmi2Component, fmi2FMUstate *);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializedFMUstateSize)(fmi2Component, fmi2FMUstate, size_t *);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2SerializeFMUstate)(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
FMI2_EXPORT fmi2Status FMI2_NAME(fmi2DeSerializeFMUstate)(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *);
#endif

#endif
