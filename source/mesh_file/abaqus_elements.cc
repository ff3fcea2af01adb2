#include <snug/mesh_file/mesh_formats.h>
#include <snug/mesh_file/mesh_text.h>

#include <algorithm>
#include <cstdlib>

namespace snug::mesh_file {
ElementType abaqus_type(const std::string &name, unsigned long line)
{
  using S                                      = ElementShape;
  static const std::map<unsigned int, S> solid = {{4, S::tetrahedron},  {5, S::pyramid},
                                                  {6, S::prism},        {8, S::hexahedron},
                                                  {10, S::tetrahedron}, {15, S::prism},
                                                  {20, S::hexahedron},  {27, S::hexahedron}};
  static const std::map<unsigned int, S> flat  = {{3, S::triangle},
                                                  {4, S::quadrilateral},
                                                  {6, S::triangle},
                                                  {8, S::quadrilateral},
                                                  {9, S::quadrilateral}};
  static const std::map<unsigned int, S> thin  = {{2, S::line}, {3, S::line}};
  using Families = std::vector<std::pair<std::string, const std::map<unsigned int, S> *>>;
  // A family that is a prefix of others follows them, because otherwise CPE would match CPEG4, and
  // S would match STRI3.
  static const Families families = {{"DC3D", &solid}, {"C3D", &solid}, {"CPS", &flat},
                                    {"CPEG", &flat},  {"CPE", &flat},  {"CAX", &flat},
                                    {"SFM3D", &flat}, {"STRI", &flat}, {"SAX", &thin},
                                    {"S", &flat},     {"M3D", &flat},  {"R3D", &flat},
                                    {"DC2D", &flat},  {"T2D", &thin},  {"T3D", &thin},
                                    {"R2D", &thin},   {"DC1D", &thin}};
  // A family with another number of nodes is skipped, because S also begins types that are no
  // shells (SPRINGA has no number, and atoi returns 0).
  for (const auto &family : families)
    if (name.rfind(family.first, 0) == 0)
      {
        // The names SAX1 and SAX2 contain the order, all others the number of nodes.
        const unsigned int n =
          std::atoi(name.c_str() + family.first.size()) + (family.first == "SAX" ? 1 : 0);
        const auto found = family.second->find(n);
        if (found != family.second->end())
          return {found->second, n};
      }
  throw error_at_line(line, "element type '" + name + "' is not supported");
}

bool is_point_element(const std::string &name)
{
  static const std::vector<std::string> families = {"SPRING", "MASS",  "ROTARY", "DASHPOT",
                                                    "CONN",   "JOINT", "GAP",    "DCOUP",
                                                    "B2",     "B3",    "PIPE",   "FRAME"};
  return std::any_of(families.begin(), families.end(),
                     [&](const auto &family) { return name.rfind(family, 0) == 0; });
}
} // namespace snug::mesh_file
