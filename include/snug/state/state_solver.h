#ifndef snug_state_state_solver_h
#define snug_state_state_solver_h

#include <snug/state/contact_state.h>
#include <snug/state/state_problem.h>

namespace snug::state {
/// This class computes the state of a load case at given node positions, by Total FETI.
template <int dim>
class StateSolver
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// Build the problem. References must outlive this object. Collective.
  /// @throws InputError for loads, supports or pairs that are not possible.
  StateSolver(const mesh::BodyMesh<dim> &mesh,
              const mesh::Tearing       &tearing,
              const Model<dim>          &model,
              const Field               &positions,
              RunContext                &context);

  /// Run a new contact search at @p positions. Contact rows, states and warm starts from before
  /// become invalid. Collective. @throws InputError.
  void pair(const Field &positions);

  /**
   * Return the state of a load case at @p positions. The solver iterates until the certificate
   * meets the tolerance. All load cases of one geometry share its matrices and factorizations.
   * Collective.
   * @param[in] earlier states at these positions, by load case, among them that of the load case
   *   whose slips this one continues (LoadCase::after).
   * @throws TangledMesh, SolveError.
   */
  ContactState<dim> solve(const Field                          &positions,
                          const qp::WarmStart                  &start,
                          unsigned int                          load_case = 0,
                          const std::vector<ContactState<dim>> &earlier   = {});

  /// Return the multipliers of the last of @p states whose position and loads are those of a load
  /// case, the loads up to a factor and to 45 degrees, times this factor; nothing if there is none.
  /// A load step starts from the state that it continues, where all closed contacts stick.
  /// @p states and the load case are at @p positions. Collective.
  qp::WarmStart scaled_start(const std::vector<ContactState<dim>> &states,
                             const Field                          &positions,
                             unsigned int                          load_case) const;

  /// Return the relative tolerance to which solve() solves. At first this is the tolerance of the
  /// model.
  double tolerance() const { return relative_tolerance; }
  void   set_tolerance(double tolerance) { relative_tolerance = tolerance; }

  /// Continue the solution of @p state, for which feti() must be valid, from its contact forces
  /// until its certificate meets @p tolerance. Collective. @throws SolveError.
  ContactState<dim> solve_on(const ContactState<dim> &state, double tolerance) const;

  /// Return the dual problem of @p state, which must be at the geometry of the last call of solve()
  /// or restore(). The result is valid until the solver goes to another geometry.
  const feti::LoadedProblem &feti(const ContactState<dim> &state) const;

  /// Go back to the geometry of @p state, which must belong to the present pairing. Its matrices
  /// and loads are computed again if the solver has been at another geometry since. Collective.
  void restore(const ContactState<dim> &state);

  /// Return the F-mults of one linear TFETI solve on the active set of @p state, from zero at the
  /// same tolerance. Collective.
  unsigned long linear_f_mults(const ContactState<dim> &state) const;

  const mesh::BodyMesh<dim>                 &mesh() const { return problem->mesh; }
  const mesh::Tearing                       &tearing() const { return problem->tearing; }
  const Model<dim>                          &model() const { return problem->model; }
  const mesh::Surface<dim>                  &surface() const { return problem->surface; }
  const supports::DirichletConstraints<dim> &held() const { return *problem->held; }

  /// Return the first load case of each position of the bodies.
  std::vector<unsigned int> positions() const;

  /// @name Contact of a load case, in the position of its bodies
  /// @{
  const contact::Contact<dim> &contact(unsigned int load_case) const
  {
    return *problem->of(load_case).contact;
  }
  const Gluing<dim> &gluing(unsigned int load_case) const { return *problem->of(load_case).gluing; }
  /// Return whether contacts of any position have friction.
  bool has_friction() const;
  /// Return whether the states minimize a potential: there is no friction, and no load step locks a
  /// motion of the step before.
  bool has_potential() const;
  /// Return the motion of a body to the position of the load case.
  geometry::RigidMotion<dim> motion(unsigned int load_case, unsigned int body) const
  {
    return model().load_cases[load_case].position.of_body(body);
  }
  /// Return the data of the rows of B at @p positions. Collective.
  RowCoefficients<dim> rows(const Field &positions, unsigned int load_case) const
  {
    return problem->rows(positions, load_case);
  }
  /// Return the exact derivative of the data of the rows of B along @p velocity. Collective.
  RowCoefficients<dim>
  row_derivatives(const Field &positions, const Field &velocity, unsigned int load_case) const;
  /// @}

  const ResultantLoads<dim>    &resultants() const { return problem->resultants; }
  const ConcentratedLoads<dim> &concentrated() const { return problem->concentrated; }
  const Springs<dim>           &springs() const { return problem->springs; }
  const Ties<dim>              &ties() const { return *problem->ties; }
  const ReferencePoints<dim>   &points() const { return *problem->points; }
  /// Return f of a load case at @p positions. Collective.
  feti::PrimalVectors              loads(const Field &positions, unsigned int load_case) const;
  const elasticity::FaceLoad<dim> &face_load() const { return problem->face_load; }
  /// Return the assemblers of the subdomains of this rank.
  const std::vector<std::unique_ptr<Assembler<dim>>> &assemblers() const
  {
    return problem->assemblers;
  }
  /// Return the number of clusters of subdomains. Subdomains that are not joined count as clusters.
  unsigned int n_clusters() const { return problem->of(0).structure->coarse.table.n_clusters(); }
  /// Return the number of rigid body modes of all clusters.
  unsigned int n_kernel() const { return problem->of(0).structure->coarse.table.n_kernel(); }
  RunContext  &context() const { return problem->context; }

private:
  ContactState<dim> solve_present(const Field               &positions,
                                  const qp::WarmStart       &start,
                                  unsigned int               load_case,
                                  double                     tolerance,
                                  const std::vector<double> &slips) const;
  void solve_to_certificate(const qp::WarmStart &start, ContactState<dim> &state) const;

  std::unique_ptr<StateProblem<dim>> problem;
  unsigned int                       n_pairings = 0;
  double                             relative_tolerance;
};
} // namespace snug::state

#endif
