#ifndef snug_scene_output_parameters_h
#define snug_scene_output_parameters_h

#include <snug/base/run_context.h>

#include <string>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::scene {
/// Entries of `subsection Output`.
struct OutputParameters
{
  Verbosity verbosity = Verbosity::normal; ///< of the log
  /// fields besides displacement and body
  std::vector<std::string> fields         = {"stress",         "von_mises", "principal_stress",
                                             "region",         "subdomain", "design_displacement",
                                             "shape_gradient", "error"};
  unsigned int             compression    = 1; ///< compression level of zlib
  unsigned int             ranks_per_file = 0; ///< number of ranks that share a file; 0: automatic
  bool                     export_qp      = false;
  std::vector<std::string> meshes         = {}; ///< formats of files of the bodies: msh, inp
  /// maximum deviation of profile.step from the design, relative to the size of a face; 0: no file
  double profile_deviation = 1e-6;

  bool has(const std::string &field) const;

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;
};
} // namespace snug::scene

#endif
