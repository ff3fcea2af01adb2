#include <snug/elasticity/semi_analytic.h>
#include <snug/sensitivity/bound_derivatives.h>
#include <snug/sensitivity/data_derivatives.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace snug::sensitivity {
namespace {
template <int dim>
using Nodes = std::vector<dealii::Tensor<1, dim>>;

template <int dim>
double largest(const Nodes<dim> &V)
{
  double norm = 0.;
  for (const auto &v : V)
    norm = std::max(norm, v.norm());
  return norm;
}

/// Return the stencil of derivatives that are not exact.
elasticity::Stencil stencil_of(const Derivatives derivatives)
{
  const bool forward =
    derivatives == Derivatives::forward || derivatives == Derivatives::refined_forward;
  return stencil(forward ? elasticity::Differences::forward : elasticity::Differences::central);
}

/// Return the differences for derivatives that are not exact.
template <int dim>
elasticity::SemiAnalytic<dim> semi_analytic(const state::StateSolver<dim> &solver,
                                            const GradientParameters      &parameters)
{
  const bool refined = parameters.derivatives == Derivatives::refined_forward ||
                       parameters.derivatives == Derivatives::refined_central;
  return elasticity::SemiAnalytic<dim>(stencil_of(parameters.derivatives), refined,
                                       parameters.semi_analytic_step, solver.mesh().idealization());
}

/// The subdomain and the state whose data are differentiated.
template <int dim>
struct SubdomainDerivative
{
  using Field     = mesh::Field<dim>;
  using Tractions = typename state::ResultantLoads<dim>::Tractions;

  const state::StateSolver<dim>       &solver;
  const state::ContactState<dim>      &state;
  const elasticity::SemiAnalytic<dim> *differences; ///< null: exact
  unsigned int                         s;

  /// Add the derivative along velocity j to column j of @p ft.
  void add_cells(const std::vector<Field> &velocities, qp::MultiVector &ft) const;
  void add_faces(const Field     &velocity,
                 const Tractions &tractions,
                 const Tractions &changes,
                 double          *ft) const;

private:
  std::vector<Nodes<dim>> internal_force_derivatives(unsigned int                   i,
                                                     const Nodes<dim>              &X,
                                                     const std::vector<Nodes<dim>> &V) const;
};

template <int dim>
void SubdomainDerivative<dim>::add_cells(const std::vector<Field> &velocities,
                                         qp::MultiVector          &ft) const
{
  const auto &assembler = *solver.assemblers()[s];
  const bool  loaded    = assembler.has_cell_loads(state.load_case);
  for (unsigned int i = 0; i < assembler.cells().size(); ++i)
    {
      std::vector<unsigned int> moving; // velocities that move the cell
      std::vector<Nodes<dim>>   V;
      for (unsigned int j = 0; j < velocities.size(); ++j)
        {
          auto of_cell = assembler.cell_field(i, velocities[j]);
          if (largest<dim>(of_cell) == 0.)
            continue;
          moving.push_back(j);
          V.push_back(std::move(of_cell));
        }
      if (moving.empty())
        continue;
      const auto X = assembler.cell_field(i, state.positions);
      const auto r = internal_force_derivatives(i, X, V);
      for (unsigned int j = 0; j < moving.size(); ++j)
        assembler.add_cell_vector(i, -1., r[j], ft.column(moving[j]));
      if (!loaded)
        continue;
      const auto force = [&](const Nodes<dim> &x, Nodes<dim> &f) {
        f = assembler.cell_load(i, x, state.load_case);
      };
      for (unsigned int j = 0; j < moving.size(); ++j)
        assembler.add_cell_vector(i, 1.,
                                  differences == nullptr
                                    ? assembler.cell_load_derivative(i, X, V[j], state.load_case)
                                    : differences->load_derivative(force, X, V[j]),
                                  ft.column(moving[j]));
    }
}

/// Return the derivatives of the internal force of cell i at X, one for each velocity.
template <int dim>
std::vector<Nodes<dim>>
SubdomainDerivative<dim>::internal_force_derivatives(const unsigned int             i,
                                                     const Nodes<dim>              &X,
                                                     const std::vector<Nodes<dim>> &V) const
{
  const auto &assembler = *solver.assemblers()[s];
  const auto &element   = assembler.element();
  const auto &material  = assembler.material(i);
  const auto  u         = assembler.cell_values(i, state.u[s].column(0));
  if (differences == nullptr)
    return element.internal_force_derivatives(X, V, material, u);
  std::vector<Nodes<dim>> r(V.size());
  for (unsigned int j = 0; j < V.size(); ++j)
    differences->internal_force_derivative(element, X, V[j], material, u, r[j]);
  return r;
}

/// Resultants change the loads of a whole face even if only a part of the face
/// moves. The tractions of resultants are therefore differentiated exactly.
template <int dim>
void SubdomainDerivative<dim>::add_faces(const Field     &velocity,
                                         const Tractions &tractions,
                                         const Tractions &changes,
                                         double          *ft) const
{
  const auto &assembler = *solver.assemblers()[s];
  const auto &face_load = solver.face_load();
  for (unsigned int i = 0; i < assembler.loaded_faces().size(); ++i)
    {
      const auto V      = assembler.face_field(i, velocity);
      const auto X      = assembler.face_field(i, state.positions);
      const auto load   = assembler.face_load_values(i, state.load_case, tractions);
      const auto change = assembler.linear_traction(i, state.load_case, changes);
      Nodes<dim> r;
      face_load.force_derivative(X, Nodes<dim>(V.size()), load, change, r);
      assembler.add_face_vector(i, 1., r, ft);
      if (largest<dim>(V) == 0.)
        continue;
      if (differences == nullptr)
        face_load.force_derivative(X, V, load, {}, r);
      else
        r = differences->load_derivative([&](const Nodes<dim> &x,
                                             Nodes<dim>       &f) { face_load.force(x, load, f); },
                                         X, V);
      assembler.add_face_vector(i, 1., r, ft);
    }
}

/// Compute rows <- rows + weight * of. Both arguments have the same entries.
template <int dim>
void add(double                                weight,
         const std::vector<contact::Row<dim>> &of,
         std::vector<contact::Row<dim>>       &rows)
{
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      auto       &row   = rows[i];
      const auto &other = of[i];
      for (unsigned int k = 0; k < row.coefficients.size(); ++k)
        row.coefficients[k].second += weight * other.coefficients[k].second;
      row.gap += weight * other.gap;
      row.normal += weight * other.normal;
    }
}

template <int dim>
void add(double weight, const state::RowCoefficients<dim> &of, state::RowCoefficients<dim> &rows)
{
  add(weight, of.contact, rows.contact);
  rows.held.add(weight, of.held);
}

/// Return the minimum diagonal of the boundary faces of the bodies over the maximum
/// velocity of a face node. Collective.
template <int dim>
double
time_across_face(const state::StateSolver<dim> &solver, const Nodes<dim> &X, const Nodes<dim> &V)
{
  double size = std::numeric_limits<double>::max(), speed = 0.;
  for (const auto &face : solver.mesh().boundary_faces())
    {
      size = std::min(size, (X[face.nodes.back()] - X[face.nodes[0]]).norm());
      for (const unsigned int node : face.nodes)
        speed = std::max(speed, V[node].norm());
    }
  const MPI_Comm comm = solver.context().communicator();
  size                = dealii::Utilities::MPI::min(size, comm);
  speed               = dealii::Utilities::MPI::max(speed, comm);
  return speed > 0. ? size / speed : 0.;
}

/// Return the derivatives of the coefficients of the rows of B along a velocity. Collective.
template <int dim>
state::RowCoefficients<dim> row_derivatives(const state::StateSolver<dim>  &solver,
                                            const state::ContactState<dim> &state,
                                            const Nodes<dim>               &V,
                                            const GradientParameters       &parameters)
{
  const auto  &X    = state.positions;
  const double time = time_across_face(solver, X, V);
  if (parameters.derivatives == Derivatives::exact || time == 0.)
    return solver.row_derivatives(X, V, state.load_case);
  const auto                  stencil = stencil_of(parameters.derivatives);
  const double                step    = parameters.semi_analytic_step * time;
  state::RowCoefficients<dim> result;
  for (unsigned int k = 0; k < stencil.places.size(); ++k)
    {
      auto x = X;
      for (unsigned int a = 0; a < X.size(); ++a)
        x[a] += stencil.places[k] * step * V[a];
      const auto rows = solver.rows(x, state.load_case);
      if (k == 0)
        {
          result = rows;
          add(-1., rows, result);
        }
      add(stencil.weights[k] / step, rows, result);
    }
  // Springs, ties and motions of points are differentiated exactly, and tangential rows are known
  // functions of the normal rows.
  result.springs      = solver.springs().row_derivatives(X, V);
  const auto &contact = solver.contact(state.load_case);
  const auto &surface = solver.surface();
  const auto  x = surface.gather(X), v = surface.gather(V);
  result.tangents = contact.tangent_row_derivatives(x, v, contact.rows(x), result.contact);
  result.ties     = solver.ties().row_derivatives(x, v);
  if (!solver.points().empty())
    solver.points().differentiate(x, v, solver.rows(X, state.load_case), contact, result);
  return result;
}

/// Add -B'^T lambda to ft and B' u to the local rows Bu, both for one column.
void add_row_derivatives(const std::vector<feti::BEntry> &B_derivative,
                         const qp::MultiVector           &lambda,
                         const qp::MultiVector           &u,
                         double                          *ft,
                         double                          *Bu)
{
  for (const auto &entry : B_derivative)
    {
      ft[entry.dof] -= entry.value * lambda(entry.row);
      Bu[entry.row] += entry.value * u(entry.dof);
    }
}
} // namespace

template <int dim>
KktVectors data_derivatives(const state::StateSolver<dim>       &solver,
                            const state::ContactState<dim>      &state,
                            const std::vector<mesh::Field<dim>> &velocities,
                            const GradientParameters            &parameters)
{
  const unsigned int k         = velocities.size();
  const auto        &gluing    = solver.gluing(state.load_case);
  const auto        &layout    = gluing.layout();
  const auto         lambda    = layout.to_local(state.dual.lambda);
  const auto         rows      = solver.rows(state.positions, state.load_case);
  const auto         tractions = solver.resultants().tractions(state.positions);
  KktVectors         result;
  result.primal = feti::PrimalVectors(k);
  for (const auto &u : state.u)
    result.primal.emplace_back(u.n_rows());
  qp::MultiVector Bu(layout.n_local(), k);
  result.dual = qp::MultiVector(layout.n_owned(), k);
  std::unique_ptr<elasticity::SemiAnalytic<dim>> differences;
  if (parameters.derivatives != Derivatives::exact)
    differences =
      std::make_unique<elasticity::SemiAnalytic<dim>>(semi_analytic(solver, parameters));
  for (unsigned int s = 0; s < state.u.size(); ++s)
    SubdomainDerivative<dim>{solver, state, differences.get(), s}.add_cells(velocities,
                                                                            result.primal[s]);
  std::vector<feti::BEntry> B_derivative;
  for (unsigned int j = 0; j < k; ++j)
    {
      const auto derivative = row_derivatives<dim>(solver, state, velocities[j], parameters);
      const auto g          = gluing.right_hand_side_derivative(rows, derivative, state.load_case);
      std::copy_n(g.column(0), g.n_rows(), result.dual.column(j));
      const auto D = gluing.compliance_derivatives(rows, derivative);
      for (unsigned int i = 0; i < D.size(); ++i)
        result.dual(i, j) += D[i] * state.dual.lambda(i);
      const auto changes = solver.resultants().traction_derivatives(state.positions, velocities[j]);
      for (unsigned int s = 0; s < state.u.size(); ++s)
        {
          const SubdomainDerivative<dim> subdomain{solver, state, differences.get(), s};
          double                        *ft = result.primal[s].column(j);
          subdomain.add_faces(velocities[j], tractions, changes, ft);
          gluing.fill_B_derivative(s, rows, derivative, B_derivative);
          add_row_derivatives(B_derivative, lambda, state.u[s], ft, Bu.column(j));
        }
    }
  result.dual.add(-1., layout.to_owned(Bu));
  result.given = bound_derivatives(solver, state, velocities);
  return result;
}

#define SNUG_INSTANTIATE(dim)                                                 \
  template KktVectors data_derivatives(const state::StateSolver<dim> &,       \
                                       const state::ContactState<dim> &,      \
                                       const std::vector<mesh::Field<dim>> &, \
                                       const GradientParameters &);
SNUG_INSTANTIATE(2)
SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
} // namespace snug::sensitivity
