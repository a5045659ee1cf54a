/* A host without any sense: does what each line of its standard input says, and prints what comes of it.
 *
 *     host LIBRARY SCRIPT
 *
 * Words are separated by blanks; in texts a blank is %20, and - is NULL. Every answer is one line `= status values`;
 * what the FMU logs comes before it as `log status category text`. Slots are numbers; an empty slot holds NULL.
 * Reals go in and out as the 16 hex digits of their bits. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmu_library.h"
#include "host.h"

enum { LINE_LENGTH = 65536, WORDS = 2048 };

Fmu fmu;
Slot slots[SLOTS];
static char *words[WORDS];
static int count;

static void on_log(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    (void)environment;
    char text[4096];
    char *to = text;
    /* As hosts do: the message is a format; here one without arguments. */
    for (const char *from = message; *from != 0 && to < text + sizeof text - 1; from++) {
        if (*from == '%' && from[1] == '%') {
            from++;
        } else if (*from == '%') {
            puts("! a log text that C hosts would expand");
        }
        *to++ = *from == '\n' ? ' ' : *from;
    }
    *to = 0;
    printf("log %d %s %s: %s\n", (int)status, category, instance, text);
}

const fmi2CallbackFunctions HOST_CALLBACKS = {on_log, calloc, free, NULL, NULL};

char *text_of(char *word)
{
    char *to = word;
    if (strcmp(word, "-") == 0) {
        return NULL;
    }
    for (char *from = word; *from != 0; from++) {
        if (strncmp(from, "%20", 3) == 0) {
            *to++ = ' ';
            from += 2;
        } else {
            *to++ = *from;
        }
    }
    *to = 0;
    return word;
}

double real_of(const char *word)
{
    uint64_t bits = strtoull(word, NULL, 16);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

void print_real(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    printf(" %016llx", (unsigned long long)bits);
}

static Slot *slot_of(int word)
{
    int number = word < count ? atoi(words[word]) : 0;
    return &slots[number >= 0 && number < SLOTS ? number : 0];
}

static int split(char *line)
{
    int found = 0;
    for (char *word = strtok(line, " \r\n"); word != NULL && found < WORDS; word = strtok(NULL, " \r\n")) {
        words[found++] = word;
    }
    for (int i = found; i < WORDS; i++) {
        words[i] = (char *)"0";
    }
    return found;
}

int main(int argument_count, char **arguments)
{
    static char line[LINE_LENGTH];
    if (argument_count < 3) {
        fputs("usage: host LIBRARY SCRIPT\n", stderr);
        return 2;
    }
    const char *missing = load_fmu(arguments[1], &fmu);
    if (missing != NULL) {
        printf("! %s\n", missing[0] != 0 ? missing : "the library cannot be loaded");
        return 2;
    }
    FILE *script = fopen(arguments[2], "rb");
    if (script == NULL) {
        return 2;
    }
    while (fgets(line, sizeof line, script) != NULL) {
        count = split(line);
        if (count == 0) {
            continue;
        }
        int known = 0;
        for (const Command *command = COMMANDS; command->name != NULL && !known; command++) {
            if (strcmp(command->name, words[0]) == 0) {
                known = 1;
                command->run(slot_of(1), words + 2, count > 2 ? count - 2 : 0);
            }
        }
        if (!known) {
            printf("! there is no command %s\n", words[0]);
        }
        fflush(stdout);
    }
    fclose(script);
    for (int i = 0; i < SLOTS; i++) {
        /* A state must be freed while there is an instance: the script has to do that. */
        free(slots[i].bytes);
        fmu.FreeInstance(slots[i].instance);
    }
    puts("end");
    return 0;
}
