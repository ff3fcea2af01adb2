#ifndef snug_accuracy_demand_h
#define snug_accuracy_demand_h

#include <snug/accuracy/targets.h>

#include <string>
#include <vector>

namespace snug::accuracy {
/// A response and its estimated error.
struct Measured
{
  double value = 0., error = 0.; ///< not finite: unknown
};

/// Return "energy 1.23 +- 0.01 (0.8 %)", or the value alone if the error is unknown.
std::string text_of(const std::string &name, const Measured &measured);

/// A target of one response in one load case, with the values and errors on the meshes so far.
struct Demand
{
  std::string         name; ///< name of the response, with the load case if there are several
  unsigned int        load_case;
  unsigned int        place; ///< index of the target in Accuracy/Target
  Target              target;
  bool                is_energy;
  bool                reads_pressure; ///< see Response::reads_pressure()
  double              factor = 1.;    ///< factor by which errors may exceed the target
  std::vector<double> errors =
    {}; ///< errors on the meshes since the last refinement for the contact
  std::vector<double> values = {}; ///< values on all meshes

  double allowed(const Measured &measured) const { return factor * target.allowed(measured.value); }

  /// Return the solver tolerance of the next mesh, see step_tolerance().
  double tolerance(const Measured &measured, double least) const;

  /// Record the value on a mesh that is refined for the contact. Discard the errors, because a
  /// changed contact is a different problem.
  void pass(const double value)
  {
    errors.clear();
    values.push_back(value);
  }

  /// Record the value and the error on a mesh. @p is_met states whether this mesh meets the demand.
  /// @return the reason why no mesh can meet the demand, or an empty string if there is no such
  /// reason.
  std::string note(const Measured &measured, bool is_met);

private:
  bool                is_noise() const;
  std::string         too_small(const Measured &measured) const;
  std::vector<double> parts() const;
};
} // namespace snug::accuracy

#endif
