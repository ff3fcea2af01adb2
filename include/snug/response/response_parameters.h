#ifndef snug_response_response_parameters_h
#define snug_response_response_parameters_h

#include <snug/base/values.h>

#include <string>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::response {
enum class Component
{
  normal,
  x,
  y,
  z,
  radial,
  tangential,
  axial
};
inline Names names(Component)
{
  return {{"normal", "displacement along the outward normal of the face; sum of the sizes of all "
                     "contact forces"},
          {"x"},
          {"y"},
          {"z"},
          {"radial", "for faces and reactions, along the radius about the 'Axis' of the body"},
          {"tangential", "around the axis"},
          {"axial", "along the axis"}};
}

/// Entries of `subsection Response NAME`, or the defaults of a response that is named by its
/// quantity alone.
struct ResponseParameters
{
  std::string name;                          ///< empty: name of the quantity
  std::string quantity = "potential energy"; ///< name in response_table()
  std::string body;                          ///< empty: all bodies
  std::string face;                          ///< name "body.boundary"
  std::string reference_point, bolt;         ///< names
  /// point in the reference geometry [length]
  std::vector<double> point;
  Component           component = Component::normal;
  std::string         pair; ///< "slave: master"; empty: all pairs
  double              exponent = 8.;
  double smoothing = 0.1; ///< threshold of the contact area, relative to the mean pressure

  std::string section() const { return "Response " + name; }

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;

  /// Return whether the quantity reads an entry.
  bool reads(const std::string &entry) const;

  /// Return the path of an entry, for messages.
  std::string path(const std::string &entry) const { return section() + "/" + entry; }
};
} // namespace snug::response

#endif
