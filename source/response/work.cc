#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>
#include <snug/state/thermal.h>

namespace snug::response {
namespace {
template <int dim>
class Work : public Response<dim>
{
public:
  using State = state::ContactState<dim>;

  Work(double State::*value, double stiffness, double load)
    : member(value), stiffness(stiffness), load(load)
  {}

  /// Return whether J is the potential energy, which has dJ/du = Ku - f - f_T = -B'lambda.
  bool stationary() const override { return stiffness == 1. && load == -1.; }

  double value(const state::StateSolver<dim> &, const State &state) const override
  {
    // Use the values stored in the state: its energy is the dual value, which is more
    // accurate than an energy computed from u.
    return state.*member;
  }

  FieldDerivative<dim> field_derivative(const state::StateSolver<dim> &,
                                        const State &) const override
  {
    FieldDerivative<dim> result;
    result.stiffness = stiffness;
    result.load      = load;
    return result;
  }

  Partials<dim> partials(const state::StateSolver<dim> &solver, const State &state) const override
  {
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    const auto &feti = solver.feti(state);
    for (unsigned int s = 0; s < state.u.size(); ++s)
      {
        result.u.emplace_back(state.u[s].n_rows());
        result.u.back().add(load, feti.loads()[s]);
        if (stiffness != 0.)
          feti.linearization().subdomains()[s].K.multiply_add(stiffness, state.u[s],
                                                              result.u.back());
      }
    if (stiffness != 0.)
      // The gradient is d/dX (u'Ku) at fixed u, with w = u.
      state::add_stiffness_gradient(solver, state, state.u, stiffness / 2., result.positions);
    if (load != 0.)
      // The loads are dead loads: f depends on X, not on u.
      state::add_load_gradient(solver, state, state.u, load, result.positions);
    if (stiffness != 0. && !solver.springs().empty())
      add_springs(solver, state, result);
    if (state::has_temperature(solver, state))
      add_thermal(solver, state, result);
    return result;
  }

private:
  /// The springs have the energy 1/2 sum kappa (c . u)^2, which has the derivative B'lambda in u.
  void add_springs(const state::StateSolver<dim> &solver,
                   const State                   &state,
                   Partials<dim>                 &partials) const
  {
    const auto     &linear = solver.feti(state).linearization();
    qp::MultiVector forces(state.dual.lambda.n_rows());
    for (unsigned int i = 0; i < forces.n_rows(); ++i)
      if (linear.compliance(i) > 0.)
        forces(i) = stiffness * state.dual.lambda(i);
    partials.u.add(1., linear.multiply_Bt(forces));
    const auto of_u = solver.gluing(state.load_case).spring_forces(state.dual.lambda.column(0));
    solver.springs().add_energy_gradient(state.positions, of_u, state.displacement, of_u,
                                         state.displacement, stiffness / 2., partials.positions);
  }

  /// The loads contain those of thermal strains, f_T, which count in the strain energy alone. Add
  /// stiffness * (c_T - f_T'u) - load * f_T'u.
  void add_thermal(const state::StateSolver<dim> &solver,
                   const State                   &state,
                   Partials<dim>                 &partials) const
  {
    const double work = -stiffness - load;
    partials.u.add(work, state::thermal_loads(solver, state));
    state::add_thermal_gradient(solver, state, work, stiffness, partials.positions);
  }

  double State::*member;
  double         stiffness, load;
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>>
work(double state::ContactState<dim>::*value, double stiffness, double load)
{
  return std::make_unique<Work<dim>>(value, stiffness, load);
}

template std::unique_ptr<Response<2>> work(double state::ContactState<2>::*, double, double);
template std::unique_ptr<Response<3>> work(double state::ContactState<3>::*, double, double);
} // namespace snug::response
