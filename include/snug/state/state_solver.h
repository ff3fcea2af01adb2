#ifndef snug_state_state_solver_h
#define snug_state_state_solver_h

#include <snug/state/contact_state.h>
#include <snug/state/state_problem.h>

#include <memory>

namespace snug::state {
/// The bridge from bodies at a geometry to Total FETI (StateProblem) and
/// back.
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
  ~StateSolver();

  /// Pair contact anew at @p positions; contact rows and warm starts of
  /// before are no longer valid. Collective. @throws InputError.
  void pair(const Field &positions);

  /**
   * The state of a load case at @p positions. Solves on until the
   * certificate meets the tolerance. All load cases of one geometry share
   * its matrices and factorizations. Collective.
   * @throws TangledMesh, SolveError.
   */
  ContactState<dim>
  solve(const Field &positions, const qp::WarmStart &start, unsigned int load_case = 0);

  /// F-mults of one linear TFETI solve on the active set of @p state,
  /// the last one solved, from zero at the same tolerance. Collective.
  unsigned long linear_f_mults(const ContactState<dim> &state) const;

  /// Volume of one body at @p positions [length^3]. Collective.
  double volume(unsigned int body, const Field &positions) const;

  const mesh::BodyMesh<dim>      &mesh() const;
  const mesh::Tearing            &tearing() const;
  const Model<dim>               &model() const;
  const mesh::Surface<dim>       &surface() const;
  const contact::Contact<dim>    &contact() const;
  const supports::HeldNodes<dim> &held() const;
  /// What the rows of B are made of at @p positions. Collective.
  RowCoefficients<dim> rows(const Field &positions) const;
  /// Its derivative along @p velocity, exact. Collective.
  RowCoefficients<dim>       row_derivatives(const Field &positions, const Field &velocity) const;
  const ResultantLoads<dim> &resultants() const;
  /// f of a load case at @p positions. Collective.
  feti::PrimalVectors              loads(const Field &positions, unsigned int load_case) const;
  const elasticity::FaceLoad<dim> &face_load() const;
  /// Assemblers of this rank's subdomains.
  const std::vector<std::unique_ptr<Assembler<dim>>> &assemblers() const;
  /// The dual problem of the last geometry and load case solved.
  const feti::TotalFeti &feti() const;
  const Gluing<dim>     &gluing() const;
  RunContext            &context() const;

private:
  struct Data;
  std::unique_ptr<Data> data;
};
} // namespace snug::state

#endif
