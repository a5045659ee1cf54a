/* What the commands of the host program share. */
#ifndef HOST_H
#define HOST_H

#include <stddef.h>

#include "fmu_library.h"

enum { SLOTS = 16 };

/* An instance, a state and its bytes, as the script has left them. */
typedef struct {
    fmi2Component instance;
    fmi2FMUstate state;
    char *bytes;
    size_t size;
} Slot;

/* A command gets the slot its first word names, and the words behind that; words that are not there are "0". */
typedef struct {
    const char *name;
    void (*run)(Slot *slot, char **words, int count);
} Command;

extern Fmu fmu;
extern Slot slots[SLOTS];
extern const Command COMMANDS[];
extern const fmi2CallbackFunctions HOST_CALLBACKS;

/* A word as text, decoded in place; NULL for -. */
char *text_of(char *word);

/* The real whose bits are the hex digits of a word, and the other way round. */
double real_of(const char *word);
void print_real(double value);

/* Run a trajectory from a file in one instance; see replay.c. */
void replay(Slot *slot, char **words, int count);

/* Many instances at once, and two threads with an instance each. */
void many(Slot *slot, char **words, int count);
void threads(Slot *slot, char **words, int count);

#endif
