#ifndef snug_state_model_h
#define snug_state_model_h

#include <snug/base/assertions.h>
#include <snug/contact/pair.h>
#include <snug/contact/placed_surface.h>
#include <snug/elasticity/element.h>
#include <snug/elasticity/linear_traction.h>
#include <snug/feti/feti_parameters.h>
#include <snug/mesh/body_mesh.h>
#include <snug/qp/solver.h>
#include <snug/supports/spring.h>
#include <snug/supports/support.h>


#include <algorithm>
#include <functional>
#include <map>

namespace snug::state {
/// Materials of one body.
template <int dim>
struct BodyModel
{
  std::vector<elasticity::Material> materials; ///< per region
  elasticity::Formulation           formulation = elasticity::Formulation::standard;
  supports::Axis<dim>               axis        = {}; ///< of radial, tangential, axial components

  const elasticity::Material &material(const typename mesh::BodyMesh<dim>::Cell &cell) const
  {
    SNUG_ASSERT_BELOW(cell.region, materials.size());
    return materials[cell.region];
  }
};

/// Dead force at a point of a boundary, or per length along a line on it. Places are reference
/// positions; the loads stay on the material points there.
template <int dim>
struct PlacedForce
{
  dealii::Tensor<1, dim>            force; ///< [force], along a line [force / length]
  dealii::Point<dim>                from;  ///< the point, or the first end of the line
  std::optional<dealii::Point<dim>> to;    ///< the other end of the line
  /// index of the boundary of the body whose common edge with the loaded one is the line
  std::optional<unsigned int>         along;
  std::pair<std::string, std::string> entry; ///< path and value, for messages
};

/// Dead loads on one boundary. Pressure and traction [force / length^2] are functions of the
/// reference position; empty functions stand for no load.
template <int dim>
struct BoundaryLoad
{
  std::function<double(const dealii::Point<dim> &)>                 pressure;
  std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> traction;
  elasticity::Resultant<dim>                                        resultant;
  std::vector<PlacedForce<dim>>                                     concentrated = {};

  bool has_resultant() const { return resultant.force.norm() > 0. || resultant.moment.norm() > 0.; }

  /// Return the force of pressure and traction on the @p area n dA [length^2] at a reference
  /// position, without the resultant and concentrated forces [force].
  dealii::Tensor<1, dim> force_at(const dealii::Point<dim>     &reference,
                                  const dealii::Tensor<1, dim> &area) const
  {
    dealii::Tensor<1, dim> force;
    if (pressure)
      force -= pressure(reference) * area;
    if (traction)
      force += area.norm() * traction(reference);
    return force;
  }
};

/// Dead loads of one body in one load case.
template <int dim>
struct BodyLoads
{
  /// [force / length^3], function of the reference position; empty: none
  std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> body_force;
  /// temperature above that of the unstressed body, function of the reference position; empty: none
  std::function<double(const dealii::Point<dim> &)> temperature;
  dealii::Tensor<1, dim>                            gravity;    ///< [length / time^2]
  std::map<unsigned int, BoundaryLoad<dim>>         boundaries; ///< by boundary

  bool has_force_per_volume() const { return body_force || gravity.norm() > 0.; }

  /// Return the body force and the weight per volume at a reference position [force / length^3].
  dealii::Tensor<1, dim> force_per_volume(const elasticity::Material   &material,
                                          const dealii::Tensor<1, dim> &reference) const
  {
    dealii::Tensor<1, dim> force = material.density * gravity;
    if (body_force)
      force += body_force(dealii::Point<dim>(reference));
    return force;
  }
};

/// Load and support of the motion of a reference point in one load case, in the order of its
/// unknowns: U, theta (U_y alone in sections of revolution).
struct PointLoad
{
  std::vector<double>                wrench; ///< force, moment about the point; empty: none
  std::vector<std::optional<double>> held;   ///< [length, rad]; empty: nothing is held
  /// held at the motion at the end of the load case before, plus held; empty: nothing is locked
  std::vector<bool> locked = {};
};

/// A point with a rigid motion that faces and obstacles follow, or a bolt, see ReferencePoints.
template <int dim>
struct ReferencePoint
{
  std::string                    name;
  dealii::Tensor<1, dim>         place; ///< p; does not move with the design [length]
  std::vector<contact::Boundary> faces;
  std::vector<std::string>       obstacles;
  std::vector<contact::Boundary> cut;         ///< of a bolt: the boundaries of its tied pair
  double                         length = 1.; ///< L; StateProblem sets it

  bool is_bolt() const { return !cut.empty(); }
};

template <int dim>
struct LoadCase
{
  std::string                 name;          ///< may be empty for a single load case
  std::vector<BodyLoads<dim>> bodies;        ///< one per body, in the frames of the bodies
  contact::Position<dim>      position = {}; ///< of the bodies and obstacles
  /// earlier load case of equal position whose slips this load case continues, as a load step
  std::optional<unsigned int> after  = {};
  std::vector<PointLoad>      points = {}; ///< of the reference points
};

/// Definition of a state problem, in indices and not in names.
template <int dim>
struct Model
{
  std::vector<std::string>                 body_names;
  std::vector<BodyModel<dim>>              bodies;
  std::vector<LoadCase<dim>>               load_cases; ///< at least one
  std::vector<supports::Support<dim>>      supports;
  std::vector<supports::PointSupport<dim>> point_supports;
  std::vector<supports::Spring<dim>>       springs;
  std::vector<contact::Pair>               pairs;
  std::vector<contact::Pair>               ties   = {}; ///< tied pairs
  std::vector<ReferencePoint<dim>>         points = {};
  /// minimum of a cell; meshes and designs with a cell below it are rejected
  double               least_scaled_jacobian = 0.;
  feti::FetiParameters feti;
  qp::SolverParameters solver;
};

/// Return the maximum Young's modulus of all bodies [force / length^2].
template <int dim>
double largest_modulus(const Model<dim> &model)
{
  double result = 0.;
  for (const auto &body : model.bodies)
    for (const auto &material : body.materials)
      result = std::max(result, material.youngs_modulus);
  return result;
}

/// Return the boundaries of contact pairs, tied pairs and reference points, ascending.
template <int dim>
std::vector<contact::Boundary> glued_boundaries(const Model<dim> &model)
{
  auto pairs = model.pairs;
  pairs.insert(pairs.end(), model.ties.begin(), model.ties.end());
  auto result = contact::boundaries_of(pairs);
  for (const auto &point : model.points)
    result.insert(result.end(), point.faces.begin(), point.faces.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Return " in load case 'NAME'", for messages about the position of a load case. The text is empty
/// if all load cases have one position.
template <int dim>
std::string place_of(const Model<dim> &model, const unsigned int load_case)
{
  for (const auto &other : model.load_cases)
    if (!(other.position == model.load_cases[load_case].position))
      return " in load case '" + model.load_cases[load_case].name + "'";
  return "";
}
} // namespace snug::state

#endif
