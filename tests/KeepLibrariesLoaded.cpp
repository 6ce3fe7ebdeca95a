// Sanitized builds only.

// Libraries stay loaded until the program ends. Mesa's drivers (swrast_dri.so, and what GLX loads) keep 128
// bytes to 5 kB in static variables; the leak check comes after they have been unloaded, when nothing points
// to that memory any more and no suppression can name where it came from.
extern "C" int dlclose(void*) { return 0; }

// A leak of others: xrDestroyInstance of OpenXR's loader 1.0.20 forgets its record of the instance, 1.5 kB
// (mended in 1.0.33).
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libopenxr_loader.so\n";
}

// Symbol that the linker is told to look for (CMakeLists.txt): libasan has a dlclose of its own, before this
// one.
extern "C" void shoalKeepLibrariesLoaded() {}
