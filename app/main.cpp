#include "app/program.hpp"

int main(int argc, char** argv) { return nextview::run_program(argc, argv); }
