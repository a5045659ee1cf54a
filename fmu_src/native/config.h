/* How this library gets its tables: it reads resources/tables.bin, and its functions have no prefix. The sources in an
 * FMU have another file of this name, which says that the tables are among them (tables.c). */
