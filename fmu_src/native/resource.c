/* Paths, URIs and files. A path may hold any character; on Windows it becomes UTF-16 for the system. */
#if !defined(_WIN32) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* for dladdr */
#endif
#include "resource.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if !defined(AXCOMP_DRIVES)
#if defined(_WIN32)
#define AXCOMP_DRIVES 1
#else
#define AXCOMP_DRIVES 0
#endif
#endif

#if defined(_WIN32)
#include <wchar.h>
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#include <io.h>
#else
#include <dlfcn.h>
#endif
#if defined(__unix__) || defined(__APPLE__)
#define AXCOMP_POSIX
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

static int digit_of(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    return -1;
}

/* Whether a text begins with a word, which is in small letters, in letters of either case. */
static int begins_with(const char *text, const char *word)
{
    while (*word != 0 && (*text >= 'A' && *text <= 'Z' ? *text - 'A' + 'a' : *text) == *word) {
        text++;
        word++;
    }
    return *word == 0;
}

/* Skip the scheme and the authority of a file URI; a plain path is returned as it is. */
static const char *path_in_uri(const char *location, int *is_uri)
{
    *is_uri = begins_with(location, "file:");
    if (!*is_uri) {
        return location;
    }
    location += 5;
    if (strncmp(location, "//", 2) == 0) {
        location += 2;
        if (begins_with(location, "localhost/")) {
            location += 9;
        } else if (location[0] != '/') {
            return location - 2; /* //server/share/..., or a drive */
        }
    }
    while (strncmp(location, "///", 3) == 0) {
        location++;
    }
    return location;
}

#if AXCOMP_DRIVES
/* Take the slashes away before a drive, which URIs write as /C:/ or /C|/. */
static void uncover_drive(char *path)
{
    const char *drive = path + strspn(path, "/");
    if (((*drive >= 'a' && *drive <= 'z') || (*drive >= 'A' && *drive <= 'Z')) && (drive[1] == ':' || drive[1] == '|')) {
        memmove(path, drive, strlen(drive) + 1);
        path[1] = ':';
    }
}
#endif

int axcomp_path_of(const char *location, const char *file, char *path)
{
    int is_uri;
    size_t length = 0;
    path[0] = 0;
    for (const char *from = path_in_uri(location, &is_uri); *from != 0; from++) {
        int high = is_uri && *from == '%' ? digit_of(from[1]) : -1;
        int low = high >= 0 ? digit_of(from[2]) : -1;
        if (length + 2 > PATH_LENGTH) {
            return 0;
        }
        if (low >= 0 && 16 * high + low != 0) {
            path[length++] = (char)(16 * high + low);
            from += 2;
        } else {
            path[length++] = *from;
        }
    }
    path[length] = 0;
#if AXCOMP_DRIVES
    if (is_uri) {
        uncover_drive(path);
        length = strlen(path);
    }
#endif
    if (file != NULL) {
        int needs_slash = length > 0 && path[length - 1] != '/' && path[length - 1] != '\\';
        if (length + (size_t)needs_slash + strlen(file) + 1 > PATH_LENGTH) {
            return 0;
        }
        if (needs_slash) {
            path[length++] = '/';
        }
        memcpy(path + length, file, strlen(file) + 1);
    }
    return 1;
}

/* Put the path of this library into `path`; 0 if that does not work. */
static int path_of_library(char *path)
{
    static const char INSIDE = 0; /* an address in this library */
#if defined(_WIN32)
    HMODULE library;
    wchar_t wide[PATH_LENGTH];
    const DWORD flags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
    DWORD length = GetModuleHandleExA(flags, &INSIDE, &library) ? GetModuleFileNameW(library, wide, PATH_LENGTH) : 0;
    return length > 0 && length < PATH_LENGTH
        && WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, PATH_LENGTH, NULL, NULL) > 0;
#else
    Dl_info info;
    return dladdr(&INSIDE, &info) != 0 && info.dli_fname != NULL && axcomp_path_of(info.dli_fname, NULL, path);
#endif
}

int axcomp_path_beside_library(const char *file, char *path)
{
    static const char RESOURCES[] = "../../resources/";
    path[0] = 0;
    if (!path_of_library(path)) {
        return 0;
    }
    size_t length = strlen(path);
    while (length > 0 && path[length - 1] != '/' && path[length - 1] != '\\') {
        length--;
    }
    if (length + sizeof RESOURCES + strlen(file) > PATH_LENGTH) {
        return 0;
    }
    memcpy(path + length, RESOURCES, sizeof RESOURCES);
    memcpy(path + length + sizeof RESOURCES - 1, file, strlen(file) + 1);
    return 1;
}

/* Open a regular file, NULL if it is none: a pipe would be waited for, a device may do something. */
static FILE *open_file(const char *path)
{
#if defined(_WIN32)
    wchar_t wide[PATH_LENGTH];
    if (MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, wide, PATH_LENGTH) == 0
        && MultiByteToWideChar(CP_ACP, 0, path, -1, wide, PATH_LENGTH) == 0) {
        return NULL;
    }
    FILE *file = _wfopen(wide, L"rb");
    if (file != NULL && GetFileType((HANDLE)_get_osfhandle(_fileno(file))) != FILE_TYPE_DISK) {
        fclose(file);
        return NULL;
    }
    return file;
#elif defined(AXCOMP_POSIX)
    struct stat about;
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode)) {
        return NULL;
    }
    /* It may have become another one: that is not waited for either. */
    int descriptor = open(path, O_RDONLY | O_NONBLOCK);
    FILE *file = descriptor >= 0 && fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode) ? fdopen(descriptor, "rb")
                                                                                              : NULL;
    if (file == NULL && descriptor >= 0) {
        close(descriptor);
    }
    return file;
#else
    return fopen(path, "rb");
#endif
}

unsigned char *axcomp_read_file(const char *path, size_t *size)
{
    FILE *file = open_file(path);
    if (file == NULL) {
        return NULL;
    }
    unsigned char *data = NULL;
    long length = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (length >= 0 && length < 0x7fffffffL && fseek(file, 0, SEEK_SET) == 0) {
        data = (unsigned char *)malloc((size_t)length + 1u);
        if (data != NULL && fread(data, 1, (size_t)length, file) != (size_t)length) {
            free(data);
            data = NULL;
        }
        *size = (size_t)length;
    }
    fclose(file);
    return data;
}
