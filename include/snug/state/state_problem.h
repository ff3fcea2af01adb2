#ifndef snug_state_state_problem_h
#define snug_state_state_problem_h

#include <snug/contact/contact.h>
#include <snug/feti/total_feti.h>
#include <snug/state/assembler.h>
#include <snug/state/body_boxes.h>
#include <snug/state/gluing.h>

#include <memory>

namespace snug::state {
/**
 * The state problem of Total FETI at a geometry and in a load case.
 * Topology, pairing, gluing and symbolic factorizations are made once, at
 * the geometry given to the constructor. The members below are its parts,
 * to be read.
 */
template <int dim>
class StateProblem
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  /// References must outlive this object. Collective.
  StateProblem(const mesh::BodyMesh<dim> &mesh,
               const mesh::Tearing       &tearing,
               const Model<dim>          &model,
               const Field               &positions,
               RunContext                &context);

  /// Pair contact anew at @p positions; the geometry must be set again.
  /// Collective.
  void pair(const Field &positions);

  /// Matrices, rows and loads at @p positions: only subdomains whose nodes
  /// moved are assembled and factorized. Collective. @throws TangledMesh.
  void set_geometry(const Field &positions);

  /// Bring the loads and the right-hand side of a load case to feti; the
  /// geometry must be set. Collective.
  /// @throws SolveError where held displacements press bodies into another.
  void set_load_case(unsigned int load_case);

  /// What the rows of B are made of at @p positions. Collective.
  RowCoefficients<dim> rows(const Field &positions) const;

  const mesh::BodyMesh<dim>                   &mesh;
  const mesh::Tearing                         &tearing;
  const Model<dim>                             model;
  RunContext                                  &context;
  std::vector<elasticity::Element<dim>>        elements; ///< per body
  elasticity::FaceLoad<dim>                    face_load;
  ResultantLoads<dim>                          resultants;
  mesh::Surface<dim>                           surface;
  std::unique_ptr<contact::Contact<dim>>       contact;
  std::unique_ptr<supports::HeldNodes<dim>>    held;
  std::unique_ptr<Gluing<dim>>                 gluing;
  std::vector<std::unique_ptr<Assembler<dim>>> assemblers;
  std::vector<feti::SubdomainSystem>           systems;
  std::unique_ptr<feti::TotalFeti>             feti;
  RowCoefficients<dim>                         last_rows; ///< at the geometry set last
  double                                       least_scaled_jacobian = 1.; ///< of all cells there

private:
  void              glue(const Field &positions);
  std::vector<bool> moved_subdomains(const Field &positions) const;
  void              check_quality(const Field &positions, const std::vector<bool> &moved);
  void              assemble(const Field &positions, const std::vector<bool> &moved);
  void              update(const Field &positions, const std::vector<bool> &moved);
  void              check_vanished_rows(unsigned int load_case) const;

  std::vector<BodyBox<dim>> boxes;
  std::vector<double>       scaled_jacobians; ///< least, per subdomain
  Field                     last_positions;
  /// f per load case and subdomain
  std::vector<std::vector<std::vector<double>>> loads;
};
} // namespace snug::state

#endif
