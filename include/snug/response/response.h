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
/// Partial derivatives of a response J(u, force, X). An empty member is zero.
template <int dim>
struct Partials
{
  using Field = mesh::Field<dim>;

  /// dJ/du at fixed forces and positions, per subdomain of this rank.
  feti::PrimalVectors u;
  /// dJ/d(force) at fixed u and positions, per contact row and equal on all ranks: normal rows,
  /// then tangential rows unless J depends on normal forces alone. The force is lambda_i / nr_i as
  /// in ContactPoint, never lambda_i. Friction forces follow the normals without a spin, see
  /// Contact::energy_gradient().
  std::vector<double> forces;
  /// dJ/d(slip) of the load step at fixed u, forces and positions, per tangential row and equal on
  /// all ranks. u does not contain this part.
  std::vector<double> slips = {};
  /// dJ/dX at fixed u and forces: this rank's share at the local nodes, including hanging
  /// nodes. The sum over ranks is the derivative.
  Field positions;
};

/**
 * dJ/du as a functional of fields v. Partials::u contains the values of the functional for the
 * shape functions of the nodes. The functional is stiffness a(u, v) + a(motion, v) + load f(v) +
 * int traction . v dA + int stress : eps(v) dV. J is quadratic in u with the same stiffness,
 * J'' (v, v) = stiffness a(v, v).
 */
template <int dim>
struct FieldDerivative
{
  double stiffness = 0., load = 0.;
  /// virtual motion of the nodes; no columns: none
  feti::PrimalVectors motion = feti::PrimalVectors(0);
  /// traction as a function of the unit outward normal and the point of one boundary
  /// [response / length^dim]
  std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &normal,
                                       const dealii::Tensor<1, dim> &x)>
                                        traction = {};
  std::pair<unsigned int, unsigned int> boundary = {0, 0}; ///< (body, boundary) of the traction
  /// stress as a function of the stress of u at a point, in the components of the strain of v
  /// [response / length^3]
  std::function<dealii::SymmetricTensor<2, 3>(const elasticity::Material          &material,
                                              const dealii::SymmetricTensor<2, 3> &stress)>
              stress = {};
  std::string body; ///< body of the stress; empty: all bodies
};

/**
 * A scalar function J(u, force, X) of the displacements, the contact forces and the node
 * positions, with its partial derivatives. Every sensitivity method uses these partial
 * derivatives:
 * dJ/dalpha_j = dJ/dX . V_j + dJ/du . u'_j + dJ/dforce . force'_j.
 */
template <int dim>
class Response
{
public:
  virtual ~Response() = default;

  /// Return the entries of its subsection that the response reads.
  virtual std::vector<std::string> entries() const { return {}; }

  /// Return whether J depends on the solution. If not, J depends on the geometry alone and
  /// only the positions of a state are read.
  virtual bool needs_solution() const { return true; }

  /// Return whether J is zero if no material has a density.
  virtual bool needs_density() const { return false; }

  /**
   * Return whether u makes J stationary among the displacements that satisfy the contact and
   * support rows, with multipliers lambda: dJ/du = -B'lambda and dJ/dforce = 0. In this case
   * dJ/dalpha needs no solve.
   */
  virtual bool stationary() const { return false; }

  /// Return whether J depends on the distribution of the contact pressure, and not on its
  /// resultants alone.
  virtual bool reads_pressure() const { return false; }

  /// Return whether J has no limit under mesh refinement if a sharp edge is in contact, see
  /// accuracy::sharp_edges().
  virtual bool unbounded_at_edges() const { return false; }

  /// Return whether the error of J on a mesh can be estimated from field_derivative() and from the
  /// forces and areas of rows. It cannot where the state of contacts jumps between nodes.
  virtual bool has_estimate() const { return true; }

  /// Throw an InputError unless the scene contains the body, face, point or pair of the
  /// response. Collective.
  virtual void check(const state::StateSolver<dim> & /*solver*/) const {}

  /// Return dJ/du between the nodes, from which the error of J is estimated: {} if J does not
  /// depend on u, or only at points. Collective.
  virtual FieldDerivative<dim> field_derivative(const state::StateSolver<dim>  &solver,
                                                const state::ContactState<dim> &state) const = 0;

  /// Return J of pressures given at places other than the slave nodes, one set of rows per
  /// pair. Return nothing if J is not a function of the pressures.
  virtual std::optional<double> measured(const state::StateSolver<dim> & /*solver*/,
                                         unsigned int /*load_case*/,
                                         const std::vector<PressureRows> & /*of_pairs*/) const
  {
    return {};
  }

  /// Return J and its derivatives as a function of the forces and areas of all contact rows.
  /// Return nothing if J depends on further quantities. Not collective.
  virtual std::optional<Measured> of_contact(const state::StateSolver<dim> & /*solver*/,
                                             unsigned int /*load_case*/,
                                             const PressureRows & /*rows*/) const
  {
    return {};
  }

  /// Return J. Collective.
  virtual double value(const state::StateSolver<dim>  &solver,
                       const state::ContactState<dim> &state) const = 0;

  /// Return the partial derivatives of J. Collective.
  virtual Partials<dim> partials(const state::StateSolver<dim>  &solver,
                                 const state::ContactState<dim> &state) const = 0;
};

template <int dim>
using MakeResponse = std::unique_ptr<Response<dim>>(const ResponseParameters &);

/// Return the rows of the entry Quantity. Making a response throws nothing.
template <int dim>
const ChoiceTable<MakeResponse<dim>> &response_table();

/// Return the unit of a quantity of the table as an expression in length and force, such as
/// "force/length^2"; empty for quantities without a dimension.
template <int dim>
std::string unit_of(const std::string &quantity);

/// Return the response that @p parameters describe.
template <int dim>
std::unique_ptr<Response<dim>> make_response(const ResponseParameters &parameters);
} // namespace snug::response

#endif
