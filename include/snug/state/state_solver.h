#ifndef snug_state_state_solver_h
#define snug_state_state_solver_h

#include <snug/state/contact_state.h>
#include <snug/state/state_problem.h>

namespace snug::state {
/// The bridge from bodies at a geometry to Total FETI (StateProblem) and
/// back: a geometry and a load case give a state.
template <int dim>
class StateSolver
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// References must outlive this object. Collective.
  /// @throws InputError for loads, supports or pairs that cannot be.
  StateSolver(const mesh::BodyMesh<dim> &mesh,
              const mesh::Tearing       &tearing,
              const Model<dim>          &model,
              const Field               &positions,
              RunContext                &context);

  /// Pair contact anew at @p positions; contact rows, states and warm starts
  /// of before are no longer valid. Collective. @throws InputError.
  void pair(const Field &positions);

  /**
   * The state of a load case at @p positions. Solves on until the
   * certificate meets the tolerance. All load cases of one geometry share
   * its matrices and factorizations. Collective.
   * @throws TangledMesh, SolveError.
   */
  ContactState<dim>
  solve(const Field &positions, const qp::WarmStart &start, unsigned int load_case = 0);

  /// @p state solved on, from its own forces, until its certificate meets @p tolerance.
  /// Collective. @throws SolveError.
  ContactState<dim> solve_on(const ContactState<dim> &state, double tolerance) const;

  /**
   * The dual problem of @p state, of the present pairing: its matrices and
   * loads are made again where the solver has been at another geometry or
   * load case since. Valid until the solver goes elsewhere. Collective.
   */
  const feti::TotalFeti &feti(const ContactState<dim> &state) const;

  /// F-mults of one linear TFETI solve on the active set of @p state, from
  /// zero at the same tolerance. Collective.
  unsigned long linear_f_mults(const ContactState<dim> &state) const;

  const mesh::BodyMesh<dim>                 &mesh() const { return problem->mesh; }
  const mesh::Tearing                       &tearing() const { return problem->tearing; }
  const Model<dim>                          &model() const { return problem->model; }
  const mesh::Surface<dim>                  &surface() const { return problem->surface; }
  const contact::Contact<dim>               &contact() const { return *problem->contact; }
  const supports::DirichletConstraints<dim> &held() const { return *problem->held; }
  /// What the rows of B are made of at @p positions. Collective.
  RowCoefficients<dim> rows(const Field &positions) const { return problem->rows(positions); }
  /// Its derivative along @p velocity, exact. Collective.
  RowCoefficients<dim>       row_derivatives(const Field &positions, const Field &velocity) const;
  const ResultantLoads<dim> &resultants() const { return problem->resultants; }
  /// f of a load case at @p positions. Collective.
  feti::PrimalVectors              loads(const Field &positions, unsigned int load_case) const;
  const elasticity::FaceLoad<dim> &face_load() const { return problem->face_load; }
  /// Assemblers of this rank's subdomains.
  const std::vector<std::unique_ptr<Assembler<dim>>> &assemblers() const
  {
    return problem->assemblers;
  }
  const Gluing<dim> &gluing() const { return *problem->gluing; }
  /// Rigid body modes of all subdomains.
  unsigned int n_kernel() const { return problem->feti->n_kernel(); }
  RunContext  &context() const { return problem->context; }

private:
  ContactState<dim> solve(const Field         &positions,
                          const qp::WarmStart &start,
                          unsigned int         load_case,
                          double               tolerance) const;
  void solve_to_certificate(const qp::WarmStart &start, ContactState<dim> &state) const;

  /// Its matrices are a cache: states depend on positions alone.
  std::unique_ptr<StateProblem<dim>> problem;
  unsigned int                       n_pairings = 0;
};
} // namespace snug::state

#endif
