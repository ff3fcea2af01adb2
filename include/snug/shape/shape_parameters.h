#ifndef snug_shape_shape_parameters_h
#define snug_shape_shape_parameters_h

#include <map>
#include <string>
#include <vector>

namespace snug
{
  namespace shape
  {
    /// Names of the bodies in the order of the mesh, for "body.boundary".
    struct BodyNames
    {
      std::vector<std::string> names;
    };

    /// Entries of `subsection Shape` or `subsection Shape NAME`.
    struct ShapeParameters
    {
      std::string               name;           ///< empty: of the only shape
      std::string               basis = "none"; ///< of shape_basis_table()
      std::string               face;           ///< "body.boundary"
      std::vector<unsigned int> control_points; ///< per axis
      /// of the moves; empty: normal to the face
      std::vector<double> direction;
      std::vector<double> bounds;  ///< lower, upper
      std::vector<double> initial; ///< one for all, one each, or empty: 0

      /// "Shape" or "Shape NAME".
      std::string
      section() const
      {
        return name.empty() ? "Shape" : "Shape " + name;
      }

      /// Path of an entry, for messages.
      std::string
      path(const std::string &entry) const
      {
        return section() + "/" + entry;
      }
    };
  } // namespace shape
} // namespace snug

#endif
