/* Preloaded into the program when it draws without a display (see headless.hpp). It depends on OSMesa, so OSMesa's gl*
   functions come before those of libGL in the program, and what is asked of GLX is answered from OSMesa. */
#define _GNU_SOURCE
#include <GL/osmesa.h>
#include <dlfcn.h>
#include <string.h>

typedef void (*Function)(void);

/* Its presence says that the program draws headless. */
int nextview_headless_gl = 1;

/* GLEW asks for a display before it loads functions; any address will do. */
static void* some_display(void) { return &nextview_headless_gl; }

Function glXGetProcAddressARB(const unsigned char* name) {
  if (strcmp((const char*)name, "glXGetCurrentDisplay") == 0) return (Function)some_display;
  return (Function)OSMesaGetProcAddress((const char*)name);
}

Function glXGetProcAddress(const unsigned char* name) { return glXGetProcAddressARB(name); }

int glXQueryVersion(void* display, int* major, int* minor) {
  (void)display;
  *major = 1;
  *minor = 4;
  return 1;
}

const char* glXGetClientString(void* display, int name) {
  (void)display;
  (void)name;
  return "";
}

/* Loaders that open libGL by name (ImGui's) get this library in its place. It is found by the name that it was loaded
   by, though the file /proc/self/fd/N is closed by now: the loader compares names before it looks for files. */
void* dlopen(const char* file, int mode) {
  void* (*next_dlopen)(const char*, int);
  *(void**)&next_dlopen = dlsym(RTLD_NEXT, "dlopen");
  Dl_info self;
  if (file && strncmp(file, "libGL.so", 8) == 0 && dladdr(&nextview_headless_gl, &self)) file = self.dli_fname;
  return next_dlopen(file, mode);
}
