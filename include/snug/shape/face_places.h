#ifndef snug_shape_face_places_h
#define snug_shape_face_places_h

#include <snug/faces/face_shape.h>
#include <snug/shape/shaped_face.h>

#include <optional>

namespace snug::shape {
/**
 * This class finds the place on a shaped face at which the interpolation of vectors of its points,
 * such as positions or coordinates, is closest to a given vector. Vectors are interpolated as
 * positions are: by the samples of the true surface, or by the nodes of faces without samples.
 */
template <int dim>
class FacePlaces
{
public:
  using Vector = dealii::Tensor<1, dim>;

  /// A point of a face of the mesh.
  struct Place
  {
    const std::vector<unsigned int> *points; ///< surface points of the face of the mesh
    unsigned int                     degree; ///< of the shape functions
    dealii::Point<dim - 1>           xi;

    /// Return the interpolation of a field of surface points.
    template <typename Field>
    typename Field::value_type value(const Field &field) const
    {
      const auto                 values = mesh::lagrange_point<dim - 1>(degree, xi).value;
      typename Field::value_type result{};
      for (unsigned int k = 0; k < points->size(); ++k)
        result += values[k] * field[(*points)[k]];
      return result;
    }
  };

  /// A face of the mesh.
  struct Patch
  {
    Place               middle; ///< with the points of the face
    std::vector<Vector> values;
    double              radius = 0.; ///< of a ball about the first value with all values
  };

  /// @p periods are those of the components of the vectors, 0 without a period. The face must
  /// outlive this object.
  FacePlaces(const ShapedFace<dim>     &face,
             const std::vector<Vector> &values,
             const Vector              &periods = Vector());

  /// Return the place with the closest vector to @p target, or nothing if the distance of all
  /// vectors is more than @p part of the radius of their patch.
  std::optional<Place> closest(const Vector &target, double part = 1e99) const;

  const std::vector<Patch> &patches() const { return own_patches; }

private:
  Vector near(Vector target, const Patch &patch) const;

  const Vector                periods;
  const faces::FaceShape<dim> of_nodes, of_samples;
  std::vector<Patch>          own_patches; ///< per face of the surface
};
} // namespace snug::shape

#endif
