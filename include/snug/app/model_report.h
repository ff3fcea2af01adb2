#ifndef snug_app_model_report_h
#define snug_app_model_report_h

#include <snug/app/shape_problem.h>
#include <snug/io/answer.h>

#include <iosfwd>

namespace snug::app {
/// Print a line for each change that was made to a mesh file when it was read, and for each face
/// that a load case holds only because other load cases prescribe its displacement.
void print_notes(const scene::Scene &scene, std::ostream &out);

/// Print the contact pairs in all positions of the bodies, and the tied pairs: method, gaps, the
/// share of the slave side that faces the other side, and surfaces. Positions after the first are
/// printed for Verbosity = debug alone. Collective.
template <int dim>
void print_pairs(const ShapeProblem<dim> &problem);

/// Return {name, load_case, contact_conditions, gap, facing} of the contact pairs in all positions,
/// and of tied pairs, with tied_nodes instead of contact_conditions:
/// the least and the largest gap [length], and the share of the slave side that faces the other
/// side. Collective.
template <int dim>
io::Json pairs_part(const ShapeProblem<dim> &problem);

/// Warn of doubtful contact pairs and tied pairs, planes of symmetry and loads. Collective.
template <int dim>
void warn_of_model(const ShapeProblem<dim> &problem);
} // namespace snug::app

#endif
