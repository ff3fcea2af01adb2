#ifndef snug_cad_translate_h
#define snug_cad_translate_h

#include <string>

namespace snug::cad {
/**
 * Return a parameter file for the solids of a CAD file, as doc/mesh-files.md describes it: a body
 * for each solid, contact pairs of faces that are near each other, possible symmetry planes as
 * comments, and a material with placeholder values.
 *
 * @throws InputError naming the file. For one rank.
 */
std::string translate(const std::string &path);
} // namespace snug::cad

#endif
