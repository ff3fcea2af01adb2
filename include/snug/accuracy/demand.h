#ifndef snug_accuracy_demand_h
#define snug_accuracy_demand_h

#include <snug/accuracy/adaptation.h>

#include <string>
#include <vector>

namespace snug::accuracy {
/// A response and its estimated error.
struct Measured
{
  double value = 0., error = 0.; ///< not finite: not known
};

/// "energy 1.23 +- 0.01 (0.8 %)", or without an error that is not known.
std::string text_of(const std::string &name, const Measured &measured);

/// A target of a response in one load case.
struct Demand
{
  std::string         name; ///< of the response, with the load case if there are several
  unsigned int        load_case;
  unsigned int        place; ///< of the target in the entry
  Target              target;
  bool                is_energy;
  bool                reads_pressure; ///< see Response::reads_pressure()
  double              factor = 1.;    ///< that errors may be larger by
  std::vector<double> errors = {};    ///< on the last meshes that were refined for it
  std::vector<double> values = {};    ///< on all meshes

  double allowed(const Measured &measured) const { return factor * target.allowed(measured.value); }

  /// That of the next mesh, see step_tolerance().
  double tolerance(const Measured &measured, double least) const;

  /// Note the value on a mesh that is refined for the contact: another contact is another problem.
  void pass(const double value)
  {
    errors.clear();
    values.push_back(value);
  }

  /// Note what came of a mesh, on which it @p is_met or not.
  /// @return what keeps it from ever being met; empty: nothing.
  std::string note(const Measured &measured, bool is_met);

private:
  bool                is_noise() const;
  std::string         too_small(const Measured &measured) const;
  std::vector<double> parts() const;
};
} // namespace snug::accuracy

#endif
