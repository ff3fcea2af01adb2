#ifndef snug_scene_cases_h
#define snug_scene_cases_h

#include <snug/base/statements.h>

namespace snug::scene {
/**
 * Return @p statements in which each load case with `Cases = n` is replaced by the load cases
 * NAME-0 to NAME-(n-1). In case i, a number of an entry may be a formula of i, which is replaced by
 * its value; in a formula of x, y, z, i is replaced by its number.
 * @throws InputError if a number of cases is not between 1 and 1000.
 */
std::vector<Statement> with_cases(const std::vector<Statement> &statements);
} // namespace snug::scene

#endif
