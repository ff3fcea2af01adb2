#ifndef snug_state_state_problem_h
#define snug_state_state_problem_h

#include <snug/contact/contact.h>
#include <snug/feti/total_feti.h>
#include <snug/state/assembler.h>
#include <snug/state/body_boxes.h>
#include <snug/state/gluing.h>

#include <memory>
#include <optional>

namespace snug::state {
/// A geometry with the data from which its matrices were made.
template <int dim>
struct Geometry
{
  typename mesh::BodyMesh<dim>::Field positions;
  RowCoefficients<dim>                rows;                       ///< data of the rows of B
  double                              least_scaled_jacobian = 1.; ///< minimum over all cells
};

/**
 * This class is the state problem of Total FETI. Topology, pairing, gluing and symbolic
 * factorizations are made once, at the geometry given to the constructor. set() computes the
 * numbers. The members below are the parts of the problem, for reading only.
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

  /// Run a new contact search at @p positions. feti has no numbers until set(). Collective.
  void pair(const Field &positions);

  /**
   * Set the matrices, the rows and the loads of a load case of feti at @p positions. Only
   * subdomains whose nodes moved since the last call are assembled and factorized.
   * Collective. @return the geometry, valid until the next call.
   * @throws TangledMesh; SolveError where held displacements press bodies into another.
   */
  const Geometry<dim> &set(const Field &positions, unsigned int load_case);

  /// Return the data of the rows of B at @p positions. Collective.
  RowCoefficients<dim> rows(const Field &positions) const;

  const mesh::BodyMesh<dim>                           &mesh;
  const mesh::Tearing                                 &tearing;
  const Model<dim>                                     model;
  RunContext                                          &context;
  std::vector<elasticity::Element<dim>>                elements; ///< per body
  elasticity::FaceLoad<dim>                            face_load;
  ResultantLoads<dim>                                  resultants;
  mesh::Surface<dim>                                   surface;
  std::unique_ptr<contact::Contact<dim>>               contact;
  std::unique_ptr<supports::DirichletConstraints<dim>> held;
  std::unique_ptr<Gluing<dim>>                         gluing;
  std::vector<std::unique_ptr<Assembler<dim>>>         assemblers;
  std::vector<feti::SubdomainSystem>                   systems;
  std::unique_ptr<feti::TotalFeti>                     feti;

private:
  void                glue(const Field &positions);
  std::vector<bool>   moved_subdomains(const Field &positions) const;
  std::vector<double> checked_jacobians(const Field &positions, const std::vector<bool> &moved);
  void                assemble(const Field &positions, const std::vector<bool> &moved);
  void                set_geometry(const Field &positions);
  void                check_vanished_rows(unsigned int load_case) const;

  std::vector<BodyBox<dim>> boxes;
  std::vector<double>       scaled_jacobians; ///< minimum per subdomain
  /// geometry of the matrices in systems and feti; empty positions: none
  Geometry<dim>               geometry;
  Field                       paired_at;   ///< positions of the last pairing
  std::optional<unsigned int> loaded_case; ///< load case of the loads in feti
  /// f per load case and subdomain
  std::vector<std::vector<std::vector<double>>> loads;
};
} // namespace snug::state

#endif
