// The program of a floor that is linked to see what it needs (tests/CMakeLists.txt).
int main() {}
