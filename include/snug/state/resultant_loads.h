#ifndef snug_state_resultant_loads_h
#define snug_state_resultant_loads_h

#include <snug/elasticity/face_load.h>
#include <snug/state/model.h>

namespace snug::state {
/**
 * This class spreads the total forces and moments on boundaries over faces that move
 * (SpreadResultant). The tractions depend on the whole loaded boundary. All members with positions
 * are collective.
 */
template <int dim>
class ResultantLoads
{
public:
  using Field    = typename mesh::BodyMesh<dim>::Field;
  using Boundary = std::pair<unsigned int, unsigned int>; ///< body and boundary
  /// Tractions of each load case and loaded boundary.
  using Tractions = std::vector<std::map<Boundary, elasticity::LinearTraction<dim>>>;

  /// Collect the loaded boundaries. References must outlive this object. Collective.
  ResultantLoads(const mesh::BodyMesh<dim>        &mesh,
                 const elasticity::FaceLoad<dim>  &face_load,
                 const std::vector<LoadCase<dim>> &load_cases);

  Tractions tractions(const Field &positions) const;

  /// Return the exact derivatives of the tractions along @p velocity.
  Tractions traction_derivatives(const Field &positions, const Field &velocity) const;

  /// Add factor * d/dX (f . u) to the gradient, where f are the loads of the resultants of a load
  /// case. Add the share of this rank only.
  void add_work_gradient(unsigned int load_case,
                         const Field &positions,
                         const Field &displacement,
                         double       factor,
                         Field       &gradient) const;

private:
  using Nodes   = std::vector<dealii::Tensor<1, dim>>;
  using Moments = elasticity::AreaMoments<dim>;
  using Spread  = elasticity::SpreadResultant<dim>;

  /// Boundary with a resultant in some load case.
  struct LoadedBoundary
  {
    Boundary                  boundary;
    std::vector<unsigned int> faces;  ///< faces of this rank
    dealii::Tensor<1, dim>    origin; ///< near the centroid of the boundary
  };

  Nodes at_face(unsigned int face, const Field &field) const;
  template <typename Compute>
  std::vector<Moments>                        moments(const Compute &compute) const;
  std::vector<std::map<unsigned int, Spread>> spread(const Field &positions) const;

  const mesh::BodyMesh<dim>        &mesh;
  const elasticity::FaceLoad<dim>  &face_load;
  const std::vector<LoadCase<dim>> &load_cases;
  std::vector<LoadedBoundary>       loaded;
};
} // namespace snug::state

#endif
