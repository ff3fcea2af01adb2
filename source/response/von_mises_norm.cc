#include <snug/base/errors.h>
#include <snug/elasticity/stress.h>
#include <snug/elasticity/von_mises_power.h>
#include <snug/response/quantities.h>
#include <snug/state/cell_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace snug::response {
namespace {
template <int dim>
class VonMisesNorm : public Response<dim>
{
public:
  VonMisesNorm(const ResponseParameters &parameters, const bool over_yield)
    : body(parameters.body), p(parameters.exponent), over_yield(over_yield)
  {}

  std::vector<std::string> entries() const override { return {"Body", "Exponent"}; }

  /// Return true, because the contact pressure determines the stresses near a contact.
  bool reads_pressure() const override { return true; }

  void check(const state::StateSolver<dim> &solver) const override
  {
    for (unsigned int b = 0; b < solver.model().bodies.size(); ++b)
      for (const auto &material : solver.model().bodies[b].materials)
        if ((body.empty() || body == solver.model().body_names[b]) && unit_of(material) > 0.)
          return;
    throw bad_entry("Quantity", "yield utilization",
                    "no material of " + (body.empty() ? "the bodies" : "body '" + body + "'") +
                      " has a 'Yield stress'");
  }

  double value(const state::StateSolver<dim>  &solver,
               const state::ContactState<dim> &state) const override
  {
    const auto of = integrals(solver, state);
    // Division by the volume makes J equal to the stress if the stress is uniform.
    return of.scale * std::pow(of.power / of.volume, 1. / p);
  }

  Partials<dim> partials(const state::StateSolver<dim>  &solver,
                         const state::ContactState<dim> &state) const override
  {
    const auto    of = integrals(solver, state);
    Partials<dim> result;
    result.positions.resize(solver.mesh().n_points());
    for (const auto &assembler : solver.assemblers())
      result.u.emplace_back(assembler->n_dofs());
    if (of.scale == 0.)
      return result;
    // dJ = J/p (dS/S - dV/V). The scale in S cancels in J and is differentiated as a constant.
    const double                         J = of.scale * std::pow(of.power / of.volume, 1. / p);
    const elasticity::VonMisesPower<dim> power(solver.mesh().degree(), solver.mesh().idealization(),
                                               p);
    for_each_cell(solver, [&](unsigned int s, unsigned int i, const double unit) {
      const auto                         &assembler = *solver.assemblers()[s];
      const auto                          X         = assembler.cell_field(i, state.positions);
      std::vector<dealii::Tensor<1, dim>> by_u(X.size()), by_X(X.size());
      power.add_gradients(X, assembler.material(i), assembler.cell_values(i, state.u[s].column(0)),
                          of.scale * unit, J / (p * of.power), by_u, by_X,
                          assembler.thermal_strain(i, state.load_case));
      assembler.element().add_volume_gradient(X, -J / (p * of.volume), by_X);
      // dJ/du belongs to the unknowns of the subdomain, where masters replace hanging nodes.
      // dJ/dX belongs to the nodes of the mesh, including hanging nodes.
      assembler.add_cell_vector(i, 1., by_u, result.u[s].column(0));
      state::add_to_cell_nodes(solver, s, i, by_X, result.positions);
    });
    return result;
  }

  /// Return J' v = J/S int s^(p-1) ds dV with s = sigma_vM / scale / unit, and sigma_vM' = 3 mu dev
  /// sigma : eps(v) / sigma_vM. In plane stress eps_zz is -nu/(1-nu) times the trace in the plane.
  FieldDerivative<dim> field_derivative(const state::StateSolver<dim>  &solver,
                                        const state::ContactState<dim> &state) const override
  {
    FieldDerivative<dim> result;
    const auto           of = integrals(solver, state);
    if (of.scale == 0.)
      return result;
    const double J = of.scale * std::pow(of.power / of.volume, 1. / p);
    const bool   is_sheet =
      solver.mesh().idealization().kind == mesh::Idealization::Kind::plane_stress;
    result.body   = body;
    result.stress = [=, *this](const elasticity::Material          &material,
                               const dealii::SymmetricTensor<2, 3> &stress) {
      const double scale = of.scale * unit_of(material);
      const double s     = scale > 0. ? elasticity::von_mises(stress) / scale : 0.;
      if (s == 0.)
        return dealii::SymmetricTensor<2, 3>();
      const double factor =
        J / of.power * std::pow(s, p - 2.) * 3. * material.lame_mu() / (scale * scale);
      auto flux = factor * deviator(stress);
      if (is_sheet)
        {
          const double nu = material.poissons_ratio, across = -nu / (1. - nu) * flux[2][2];
          flux[0][0] += across;
          flux[1][1] += across;
          flux[2][2] = 0.;
        }
      return flux;
    };
    return result;
  }

private:
  /// Return what divides the stresses of a material: 1 or its yield stress. Cells without a yield
  /// stress are left out.
  double unit_of(const elasticity::Material &material) const
  {
    return over_yield ? material.yield_stress : 1.;
  }

  template <typename Work>
  void for_each_cell(const state::StateSolver<dim> &solver, const Work &work) const
  {
    state::for_each_cell<dim>(solver, body, [&](unsigned int s, unsigned int i) {
      if (const double unit = unit_of(solver.assemblers()[s]->material(i)); unit > 0.)
        work(s, i, unit);
    });
  }

  /// S = int (sigma_vM / unit / scale)^p dV with the maximum of sigma_vM / unit as the scale, and
  /// the volume. The scale is 0 if there is no stress.
  struct Integrals
  {
    double scale = 0., power = 0., volume = 0.;
  };

  Integrals integrals(const state::StateSolver<dim>  &solver,
                      const state::ContactState<dim> &state) const
  {
    using Power         = elasticity::VonMisesPower<dim>;
    const auto    &mesh = solver.mesh();
    const MPI_Comm comm = solver.context().communicator();
    Integrals      result;
    // Compute the scale first, because otherwise large exponents overflow or underflow.
    const Power power(mesh.degree(), mesh.idealization(), p);
    for_each_cell(solver, [&](unsigned int s, unsigned int i, const double unit) {
      const auto &assembler = *solver.assemblers()[s];
      const auto  X         = assembler.cell_field(i, state.positions);
      result.volume += assembler.element().volume(X);
      result.scale =
        std::max(result.scale, power.largest(X, assembler.material(i),
                                             assembler.cell_values(i, state.u[s].column(0)),
                                             assembler.thermal_strain(i, state.load_case)) /
                                 unit);
    });
    result.scale  = dealii::Utilities::MPI::max(result.scale, comm);
    result.volume = dealii::Utilities::MPI::sum(result.volume, comm);
    // All ranks return here together, because the scale is the maximum over all ranks.
    if (result.scale == 0.)
      return result;
    for_each_cell(solver, [&](unsigned int s, unsigned int i, const double unit) {
      const auto &assembler = *solver.assemblers()[s];
      result.power +=
        power.value(assembler.cell_field(i, state.positions), assembler.material(i),
                    assembler.cell_values(i, state.u[s].column(0)), result.scale * unit,
                    assembler.thermal_strain(i, state.load_case));
    });
    result.power = dealii::Utilities::MPI::sum(result.power, comm);
    return result;
  }

  const std::string body; ///< empty: all bodies
  const double      p;
  const bool        over_yield;
};
} // namespace

template <int dim>
std::unique_ptr<Response<dim>> von_mises_norm(const ResponseParameters &parameters,
                                              const bool                over_yield)
{
  return std::make_unique<VonMisesNorm<dim>>(parameters, over_yield);
}

template std::unique_ptr<Response<2>> von_mises_norm(const ResponseParameters &, bool);
template std::unique_ptr<Response<3>> von_mises_norm(const ResponseParameters &, bool);
} // namespace snug::response
