#ifndef snug_state_state_problem_h
#define snug_state_state_problem_h

#include <snug/state/assembler.h>
#include <snug/state/body_boxes.h>
#include <snug/state/position_problem.h>

namespace snug::state {
/// A geometry with the data from which its matrices were made.
template <int dim>
struct Geometry
{
  typename mesh::BodyMesh<dim>::Field positions;
  double                              least_scaled_jacobian = 1.; ///< minimum over all cells
};

/**
 * This class is the state problem of Total FETI. Patterns of the matrices are made once, pairing
 * and gluing of all positions by the constructor and again by pair(). set() computes the
 * matrices and loads of a geometry, which this class keeps until the next geometry. The public
 * members are the parts of the problem, for reading only.
 */
template <int dim>
class StateProblem
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// Build the problem. References must outlive this object. Collective.
  StateProblem(const mesh::BodyMesh<dim> &mesh,
               const mesh::Tearing       &tearing,
               const Model<dim>          &model,
               const Field               &positions,
               RunContext                &context);

  /// Run a new contact search at @p positions, and forget the present geometry. Collective.
  void pair(const Field &positions);

  /**
   * Compute the matrices at @p positions and the dual problem of a load case, unless they are
   * known. Only subdomains whose nodes moved since the last call are assembled and factorized.
   * Collective.
   * @param[in] slips of the tangential rows before this load step [length]; empty: none.
   * @throws TangledMesh; SolveError where prescribed displacements press bodies into one another.
   */
  void set(const Field &positions, unsigned int load_case, const std::vector<double> &slips = {});

  /// Return the present geometry, valid until the next call of set() or pair().
  const Geometry<dim> &geometry() const { return present; }

  /// Return the dual problem of a load case at the present geometry, valid as geometry(). set()
  /// must have been called for the load case at @p positions. @throws ExcMessage on a rank whose
  /// subdomains are at other positions, which is an error of the caller.
  const feti::LoadedProblem &loaded(const Field &positions, unsigned int load_case) const;

  /// Return the part of the problem that belongs to the position of a load case.
  const PositionProblem<dim> &of(unsigned int load_case) const
  {
    return *problems[problem_of_case[load_case]];
  }

  /// Return the data of the rows of B of a load case at @p x. Collective.
  RowCoefficients<dim> rows(const Field &x, unsigned int load_case) const;

  const mesh::BodyMesh<dim> &mesh;
  /// with the subdomains of the reference points; without clusters where soft modes are used
  mesh::Tearing                                        tearing;
  const Model<dim>                                     model;
  RunContext                                          &context;
  std::vector<elasticity::Element<dim>>                elements; ///< per body
  elasticity::FaceLoad<dim>                            face_load;
  ResultantLoads<dim>                                  resultants;
  ConcentratedLoads<dim>                               concentrated;
  mesh::Surface<dim>                                   surface;
  Springs<dim>                                         springs;
  std::unique_ptr<supports::DirichletConstraints<dim>> held;
  std::unique_ptr<Ties<dim>>                           ties;
  std::unique_ptr<ReferencePoints<dim>>                points;
  std::vector<std::unique_ptr<Assembler<dim>>>         assemblers;
  std::vector<feti::SubdomainSystem>                   systems;
  feti::FactorCache                                    factor_cache;

private:
  RowCoefficients<dim> rows_of(const PositionProblem<dim> &at, const Field &x) const;
  void                 make_positions();
  void for_each_position(const std::function<void(PositionProblem<dim> &)> &pair) const;
  void glue(const Field &x);
  void forget();
  std::vector<bool>   moved_subdomains(const Field &positions) const;
  std::vector<double> checked_jacobians(const Field &positions, const std::vector<bool> &moved);
  void                assemble(const Field &positions, const std::vector<bool> &moved);
  void                go_to(const Field &x);
  void                linearize(PositionProblem<dim> &at);
  void                check_vanished_rows(unsigned int load_case) const;

  std::vector<BodyBox<dim>> boxes;
  std::vector<double>       scaled_jacobians; ///< minimum per subdomain
  Field                     paired_at;        ///< node positions of the last pairing
  std::vector<std::unique_ptr<PositionProblem<dim>>> problems; ///< one per position
  std::vector<unsigned int>                          problem_of_case;
  /// operators that all positions share; the deflation is that of the present geometry
  feti::SharedOperators            shared;
  Geometry<dim>                    present; ///< empty positions: none
  std::vector<feti::PrimalVectors> loads;   ///< f of each load case
  /// by load case; null: not set at this geometry. They refer to the linearizations of the
  /// problems.
  std::vector<std::unique_ptr<const feti::LoadedProblem>> loaded_problems;
  std::vector<std::vector<double>>                        slips_before; ///< of loaded_problems
};
} // namespace snug::state

#endif
