// What libraries of the system never give back, told to the sanitizers' search for leaks; linked where SOILBIN_SANITIZE
// is on. fontconfig keeps what it read of fonts until a process ends (seen with 2.14.1, called by librsvg for --plot
// x.png).

extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }
