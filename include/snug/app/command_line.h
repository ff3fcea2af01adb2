#ifndef snug_app_command_line_h
#define snug_app_command_line_h

#include <string>
#include <vector>

namespace snug::app {
/// This struct holds the arguments of the command line.
struct Options
{
  std::string              file;
  std::vector<std::string> sets;      ///< "Subsection/Entry=value"
  std::string              output;    ///< directory; empty: as in the file
  std::string              petsc;     ///< options of PETSc, "-NAME VALUE -NAME ..."
  std::string              leave_out; ///< kinds of parts of a deck that are left out
  bool                     restart          = false;
  bool                     validate         = false;
  bool                     advise           = false;
  bool                     estimate         = false;
  unsigned int             ranks            = 0; ///< of the estimate; 0: those of the run
  bool                     translate        = false;
  bool                     serve            = false;
  bool                     print_parameters = false;
  bool                     json             = false; ///< form of what these two print
  bool                     help             = false;
  bool                     version          = false;
};

/// Return the options of a command line. The value of an option is the next argument or follows an
/// equals sign (--output=DIR).
/// @throws InputError naming an option that is unknown, that lacks its value, or that has a value
///   which it does not take; also for options that exclude one another, for several files, and for
///   no file if the options need one.
Options parse(int argc, const char *const *argv);

/// Return the text of --help.
std::string usage();
} // namespace snug::app

#endif
