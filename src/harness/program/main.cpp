#include "harness/program/program_main.hpp"

int main(int argc, char** argv) { return bqsa::harness::program_main(argc, argv); }
