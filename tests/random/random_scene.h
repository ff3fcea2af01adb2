#ifndef snug_tests_random_random_scene_h
#define snug_tests_random_random_scene_h

#include <string>
#include <vector>

namespace snug::test {
/// The kinds of random problems; problem n is of kind n modulo their number.
const std::vector<std::string> &kinds();

/// The parameter file of problem @p number, which is also its seed.
std::string random_scene(unsigned int number);
} // namespace snug::test

#endif
