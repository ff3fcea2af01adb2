#ifndef snug_app_command_line_h
#define snug_app_command_line_h

#include <string>
#include <vector>

namespace snug::app {
/// This struct holds the arguments of the command line.
struct Options
{
  std::string              file;
  std::vector<std::string> sets;   ///< "Subsection/Entry=value"
  std::string              output; ///< directory; empty: as in the file
  std::string              petsc;  ///< options of PETSc, "-NAME VALUE -NAME ..."
  bool                     restart          = false;
  bool                     validate         = false;
  bool                     advise           = false;
  bool                     estimate         = false;
  unsigned int             ranks            = 0; ///< of the estimate; 0: those of the run
  bool                     translate        = false;
  bool                     print_parameters = false;
  bool                     help             = false;
  bool                     version          = false;
};

/// Values may follow their option or an equals sign (--output=DIR).
/// @throws InputError naming an option that is unknown, lacks its value or
///   has one it does not take or that is none of PETSc's, and if there is not exactly one file.
Options parse(int argc, const char *const *argv);

/// Return the text of --help.
std::string usage();
} // namespace snug::app

#endif
