#include "surehit_query/query_program.hpp"

int main(int argc, char** argv) { return surehit::example::run_query_program(argc, argv); }
