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
  z
};
inline Names names(Component)
{
  return {{"normal"}, {"x"}, {"y"}, {"z"}};
}

/// Entries of `subsection Response NAME`, or the defaults of a response
/// that is named by its quantity alone.
struct ResponseParameters
{
  std::string name;                          ///< empty: that of the quantity
  std::string quantity = "potential energy"; ///< of response_table()
  std::string body;                          ///< empty: all
  std::string face;                          ///< "body.boundary"
  /// [length], in the reference geometry
  std::vector<double> point;
  Component           component = Component::normal;
  std::string         pair; ///< "slave: master"; empty: all
  double              exponent  = 8.;
  double              smoothing = 0.1; ///< of contact areas

  std::string section() const { return "Response " + name; }

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;

  /// Whether its quantity reads an entry.
  bool reads(const std::string &entry) const;

  /// Path of an entry, for messages.
  std::string path(const std::string &entry) const { return section() + "/" + entry; }
};
} // namespace snug::response

#endif
