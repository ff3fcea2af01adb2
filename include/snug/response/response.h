#ifndef snug_response_response_h
#define snug_response_response_h

#include <snug/base/choice.h>
#include <snug/response/pressure_measures.h>
#include <snug/response/response_parameters.h>
#include <snug/state/state_solver.h>

#include <functional>
#include <memory>
#include <optional>

namespace snug::response {
/// Partial derivatives of a response J(u, force, X). An empty member is
/// zero.
template <int dim>
struct Partials
{
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// dJ/du at fixed forces and positions, per subdomain of this rank.
  feti::PrimalVectors u;
  /// dJ/d(force) at fixed u and positions, per contact row and equal on all
  /// ranks; force = lambda_i / nr_i as in ContactPoint, never lambda_i.
  std::vector<double> forces;
  /// dJ/dX at fixed u and forces: this rank's share at the local nodes,
  /// hanging ones included; the sum over ranks is the whole.
  Field positions;
};

/**
 * dJ/du as a functional of fields v, where Partials::u has its values at the nodes:
 * stiffness a(u, v) + load f(v) + int traction . v dA + int stress : eps(v) dV.
 * J is quadratic in u by the same stiffness, J'' (v, v) = stiffness a(v, v).
 */
template <int dim>
struct FieldDerivative
{
  double stiffness = 0., load = 0.;
  /// by the unit outward normal of one boundary [response / length^dim]
  std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &normal)> traction = {};
  std::pair<unsigned int, unsigned int> boundary = {0, 0}; ///< of that body
  /// by the stress of u there, in the components the strain of v has [response / length^3]
  std::function<dealii::SymmetricTensor<2, 3>(const elasticity::Material          &material,
                                              const dealii::SymmetricTensor<2, 3> &stress)>
              stress = {};
  std::string body; ///< where; empty: everywhere
};

/**
 * A scalar function J(u, force, X) of the displacements, the contact
 * forces and the node positions, with the partial derivatives every
 * sensitivity method is built from:
 * dJ/dalpha_j = dJ/dX . V_j + dJ/du . u'_j + dJ/dforce . force'_j.
 */
template <int dim>
class Response
{
public:
  virtual ~Response() = default;

  /// The entries of its subsection that it reads.
  virtual std::vector<std::string> entries() const { return {}; }

  /// Whether J depends on the solution at all, or on the geometry alone:
  /// then only the positions of a state are read.
  virtual bool needs_solution() const { return true; }

  /// Whether J is zero where no material has a density.
  virtual bool needs_density() const { return false; }

  /**
   * Whether u makes J stationary among the displacements that the rows of
   * contact and supports allow, with multipliers lambda: dJ/du = -B'lambda
   * and dJ/dforce = 0. Then dJ/dalpha needs no solve.
   */
  virtual bool stationary() const { return false; }

  /// Whether J depends on how the contact pressure is distributed, and not on its resultants alone.
  virtual bool reads_pressure() const { return false; }

  /// Whether J has no limit as cells get smaller where a sharp edge presses, see
  /// accuracy::sharp_edges().
  virtual bool unbounded_at_edges() const { return false; }

  /// Throw an InputError unless the scene has what is measured.
  /// Collective.
  virtual void check(const state::StateSolver<dim> & /*solver*/) const {}

  /// What dJ/du is between nodes; zero for forces at points. Collective.
  virtual FieldDerivative<dim> field_derivative(const state::StateSolver<dim> & /*solver*/,
                                                const state::ContactState<dim> & /*state*/) const
  {
    return {};
  }

  /// J of pressures at other places than the slave nodes, for each pair its own; nothing if it is
  /// not a function of them.
  virtual std::optional<double> measured(const state::StateSolver<dim> & /*solver*/,
                                         const std::vector<PressureRows> & /*of_pairs*/) const
  {
    return {};
  }

  /// J and its derivatives as a function of the forces and areas of all contact rows; nothing: it
  /// depends on more. Not collective.
  virtual std::optional<Measured> of_contact(const state::StateSolver<dim> & /*solver*/,
                                             const PressureRows & /*rows*/) const
  {
    return {};
  }

  /// J. Collective.
  virtual double value(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const = 0;

  /// Collective.
  virtual Partials<dim> partials(const state::StateSolver<dim>  &solver,
                                 const state::ContactState<dim> &state) const = 0;
};

template <int dim>
using MakeResponse = std::unique_ptr<Response<dim>>(const ResponseParameters &);

/// Rows of the entry Quantity. Making one throws nothing.
template <int dim>
const ChoiceTable<MakeResponse<dim>> &response_table();

/// The response that @p parameters describe.
template <int dim>
std::unique_ptr<Response<dim>> make_response(const ResponseParameters &parameters);
} // namespace snug::response

#endif
