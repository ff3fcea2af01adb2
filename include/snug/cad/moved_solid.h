#ifndef snug_cad_moved_solid_h
#define snug_cad_moved_solid_h

#include <snug/cad/write_step.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <memory>

namespace snug::cad {
/**
 * This class is the solid of a CAD file in which faces have new surfaces. A moved face keeps its
 * parameters (u, v) and its edges in them. The edges of the faces beside it are cut anew, and these
 * faces keep their surfaces, on which the moved edges have to lie.
 */
class MovedSolid
{
public:
  /// Read the shape @p brep of ImportedMesh and place it: x' = Q s x + t.
  MovedSolid(const std::string           &brep,
             double                       scale,
             const dealii::Tensor<2, 3>  &rotation,
             const std::array<double, 3> &shift);

  /// The ranges of the parameters of a face.
  struct Domain
  {
    dealii::Tensor<1, 2> lower, upper;
    std::array<bool, 2>  closed; ///< true if the range is the period of the surface
  };

  Domain domain(unsigned int face) const;

  /// Return the point of the surface of a face.
  dealii::Point<3> point(unsigned int face, const dealii::Tensor<1, 2> &parameters) const;

  /**
   * Write the solid with the surfaces @p moved (index of the face -> surface over its domain) to a
   * STEP file as a product with the name @p name, whose faces have the names @p names, and return
   * its volume. The faces deviate from the design by at most @p tolerance [length].
   * @throws InputError if the solid would not be valid, with the reason.
   */
  double write(const std::string                        &path,
               const std::string                        &unit,
               const std::string                        &name,
               const std::vector<std::string>           &names,
               const std::map<unsigned int, SplineFace> &moved,
               double                                    tolerance) const;

private:
  struct Shapes;

  std::shared_ptr<const Shapes> shapes;
};
} // namespace snug::cad

#endif
