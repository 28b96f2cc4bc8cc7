/* Tells that it was loaded into a program: with a file in the working folder. */
#include <stdio.h>

__attribute__((constructor)) static void tell(void) {
  FILE* file = fopen("planted_was_loaded", "w");
  if (file) fclose(file);
}
