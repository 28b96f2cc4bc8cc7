/* Loaded before a program, it has the graphics driver say NEXTVIEW_LOSE_CONTEXT times, in each frame anew, that it lost
 * all that it was given, until the program takes another context: as after a reset of a graphics card, which the
 * processors that draw here do not have. The old context is still there, but what was in it is gone with it once the
 * program leaves it. How many windows were opened stands in the file NEXTVIEW_WINDOWS. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FRAMES 25 /* that a context lives */
typedef void (*Function)(void);

static int windows, frames;

static unsigned int reset_status(void) {
  const char* text = getenv("NEXTVIEW_LOSE_CONTEXT");
  if (windows > (text ? atoi(text) : 0)) return 0;
  return ++frames > FRAMES ? 0x8254 /* GL_INNOCENT_CONTEXT_RESET */ : 0;
}

Function glfwGetProcAddress(const char* name) {
  if (strcmp(name, "glGetGraphicsResetStatusARB") == 0) return (Function)reset_status;
  return ((Function(*)(const char*))dlsym(RTLD_NEXT, "glfwGetProcAddress"))(name);
}

int glfwExtensionSupported(const char* name) {
  if (strcmp(name, "GL_ARB_robustness") == 0) return 1;
  return ((int (*)(const char*))dlsym(RTLD_NEXT, "glfwExtensionSupported"))(name);
}

void* glfwCreateWindow(int width, int height, const char* title, void* monitor, void* share) {
  const char* file = getenv("NEXTVIEW_WINDOWS");
  FILE* written = file ? fopen(file, "w") : NULL;
  if (written) fprintf(written, "%d\n", windows + 1), fclose(written);
  ++windows;
  frames = 0;
  return ((void* (*)(int, int, const char*, void*, void*))dlsym(RTLD_NEXT, "glfwCreateWindow"))(width, height, title,
                                                                                                monitor, share);
}
