/* Finds the functions of an FMU. */
#include "fmu_library.h"

#include <string.h>

#if defined(FMU_LINKED)

#define FMU_PROTOTYPE(RESULT, NAME, PARAMETERS) extern RESULT fmi2##NAME PARAMETERS;
FMU_FUNCTIONS(FMU_PROTOTYPE)

#define FMU_LINK(RESULT, NAME, PARAMETERS) fmu->NAME = fmi2##NAME;

const char *load_fmu(const char *path, Fmu *fmu)
{
    (void)path;
    FMU_FUNCTIONS(FMU_LINK)
    return NULL;
}

#else

#if defined(_WIN32)
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

static void *open_library(const char *path)
{
    return (void *)LoadLibraryA(path);
}

/* Put the address of a function into `function`: 0 if there is none. */
static int look_up(void *library, const char *name, void *function)
{
    FARPROC address = GetProcAddress((HMODULE)library, name);
    memcpy(function, &address, sizeof address);
    return address != NULL;
}
#else
#include <dlfcn.h>

static void *open_library(const char *path)
{
    return dlopen(path, RTLD_NOW | RTLD_LOCAL);
}

static int look_up(void *library, const char *name, void *function)
{
    void *address = dlsym(library, name);
    memcpy(function, &address, sizeof address);
    return address != NULL;
}
#endif

#define FMU_LOOK_UP(RESULT, NAME, PARAMETERS)                                                                          \
    if (!look_up(library, "fmi2" #NAME, &fmu->NAME) && missing == NULL) {                                              \
        missing = "fmi2" #NAME;                                                                                        \
    }

const char *load_fmu(const char *path, Fmu *fmu)
{
    const char *missing = NULL;
    void *library = open_library(path);
    memset(fmu, 0, sizeof *fmu);
    if (library == NULL) {
        return "";
    }
    FMU_FUNCTIONS(FMU_LOOK_UP)
    return missing;
}

#endif
