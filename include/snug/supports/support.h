#ifndef snug_supports_support_h
#define snug_supports_support_h

#include <snug/supports/component.h>

#include <functional>
#include <string>
#include <vector>

namespace snug::supports {
/// Displacement component held on one boundary of a body.
template <int dim>
struct Support
{
  unsigned int   body, boundary;
  Component<dim> component; ///< the normal is the nodal normal, which points outwards
  /// Prescribed displacement [length] per load case as a function of the reference position. An
  /// empty function means zero.
  std::vector<std::function<double(const dealii::Point<dim> &)>> values;
  std::string name;      ///< name as the user wrote it, for messages
  std::string face = {}; ///< "body.boundary", for results
};

/// Displacement component held at one node on a boundary of a body, in all load cases.
template <int dim>
struct PointSupport
{
  unsigned int       body, boundary;
  Component<dim>     component; ///< not the normal
  double             value;     ///< prescribed displacement [length]
  dealii::Point<dim> place;     ///< reference position of the node
  std::string        name;      ///< as the user wrote it, for messages
  std::string        face;      ///< "body.boundary", for results
};
} // namespace snug::supports

#endif
