#ifndef snug_advice_true_bodies_h
#define snug_advice_true_bodies_h

#include <snug/mesh/body_mesh.h>

#include <optional>
#include <vector>

namespace snug::advice {
/// A point of a body, by the cell of its coarse mesh that holds it.
template <int dim>
struct Place
{
  unsigned int           body, cell;
  unsigned int           boundary = 0; ///< of points of the surface
  dealii::Point<dim>     x;
  dealii::Tensor<1, dim> normal; ///< outwards, unit; zero inside
};

/**
 * The bodies as their maps say, whatever their meshes: points of their
 * surfaces and insides, and where a point lies. Every rank has it all.
 */
template <int dim>
class TrueBodies
{
public:
  explicit TrueBodies(const mesh::BodyMesh<dim> &mesh);

  /// The diagonal of the box of all bodies [length].
  double size() const { return diagonal; }

  /// @p n quasi-random points of each boundary of each body, none on an edge.
  std::vector<Place<dim>> surface_points(unsigned int n) const;

  /// @p n quasi-random points inside of each body.
  std::vector<Place<dim>> inner_points(unsigned int n) const;

  /// The place of the surface within 1e-6 of the size of @p x with about the normal @p normal; or,
  /// if that is zero, a place inside. Nothing if there is none.
  std::optional<Place<dim>> find(const dealii::Point<dim>     &x,
                                 const dealii::Tensor<1, dim> &normal) const;

private:
  /// A cell of a coarse mesh, or the boundary face 2d + s of it.
  struct Patch
  {
    static constexpr unsigned int cell_itself = 2 * dim;

    unsigned int body, cell, face, boundary;
  };

  struct Seed
  {
    unsigned int       patch;
    dealii::Point<dim> unit, x;
  };

  void                   add_patches(unsigned int body);
  void                   add_seeds(const std::vector<Patch> &patches, std::vector<Seed> &seeds);
  dealii::Point<dim>     at(const Patch &patch, const dealii::Point<dim> &unit) const;
  dealii::Tensor<2, dim> derivative(const Patch &patch, const dealii::Point<dim> &unit) const;
  Place<dim>             place(const Patch &patch, const dealii::Point<dim> &unit) const;
  dealii::Point<dim>
  closest(const Patch &patch, dealii::Point<dim> unit, const dealii::Point<dim> &x) const;
  std::vector<Place<dim>> spread(const std::vector<const Patch *> &patches, unsigned int n) const;

  const mesh::BodyMesh<dim> &mesh;
  std::vector<Patch>         faces, cells;
  std::vector<Seed>          face_seeds, cell_seeds;
  double                     diagonal = 0.;
};
} // namespace snug::advice

#endif
