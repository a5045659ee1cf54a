/* How this library gets its tables: it reads resources/tables.bin. The sources in an FMU have another file of this name,
 * which says that the tables are among them (tables.c).
 *
 * Whoever links the sources statically defines FMI2_FUNCTION_PREFIX as axcomp_; see fmi2.h. */
