#ifndef snug_state_assembler_h
#define snug_state_assembler_h

#include <snug/elasticity/face_load.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/node_reach.h>
#include <snug/mesh/tearing.h>
#include <snug/state/resultant_loads.h>

namespace snug::state {
/**
 * Assembly of one subdomain. Its unknowns are dim per node of
 * Subdomain::nodes; cells with hanging nodes act on the masters,
 * K_e -> T' K_e T.
 */
template <int dim>
class Assembler
{
public:
  using Field     = typename mesh::BodyMesh<dim>::Field;
  using Nodes     = std::vector<dealii::Tensor<1, dim>>;
  using Tractions = typename ResultantLoads<dim>::Tractions;

  Assembler(const mesh::BodyMesh<dim>       &mesh,
            const mesh::Subdomain           &subdomain,
            const Model<dim>                &model,
            const elasticity::Element<dim>  &element,
            const elasticity::FaceLoad<dim> &face_load);

  unsigned int n_dofs() const { return dim * subdomain.nodes.size(); }

  /// Pattern of K.
  feti::CsrMatrix sparsity() const;

  /// K at the given positions of the local nodes.
  void stiffness(const Field &positions, feti::CsrMatrix &K) const;

  /// f of a load case at the given positions, with the tractions of
  /// resultants there.
  std::vector<double>
  load(const Field &positions, unsigned int load_case, const Tractions &tractions) const;

  /**
   * Rigid body modes at the unknowns, orthonormal: rigid_motions() about
   * the centre of the subdomain; and Z with R Z = the body's modes, those
   * about @p centre over @p length.
   */
  void rigid_modes(const Field                  &positions,
                   const dealii::Tensor<1, dim> &centre,
                   double                        length,
                   qp::MultiVector              &R,
                   qp::MultiVector              &Z) const;

  /// Unknowns of far-apart nodes (farthest point sampling) that rigid
  /// motions move.
  std::vector<unsigned int> fixing_dofs(const Field &positions) const;

  /// Whether it is nearly a cube of cells near cubes of one size and material (a square in the
  /// plane): no motion is then much softer than its neighbours are.
  bool is_compact(const Field &positions) const;

  /// Subdomain cells and loaded boundary faces as (mesh index).
  const std::vector<unsigned int> &cells() const { return subdomain.cells; }
  const std::vector<unsigned int> &loaded_faces() const { return faces; }

  /// Values of a nodal field at the nodes of cell i of cells().
  Nodes cell_field(unsigned int i, const Field &field) const;
  /// Values of the subdomain vector u at the nodes of cell i.
  Nodes cell_values(unsigned int i, const double *u) const { return cell_reach[i].values(u); }
  /// u += factor * T' r for cell i.
  void add_cell_vector(unsigned int i, double factor, const Nodes &r, double *u) const;

  /// The same for loaded face i of loaded_faces().
  Nodes face_field(unsigned int i, const Field &field) const;
  Nodes face_values(unsigned int i, const double *u) const { return face_reach[i].values(u); }
  void  add_face_vector(unsigned int i, double factor, const Nodes &r, double *u) const;
  /// Its loads in a load case.
  elasticity::FaceLoadValues<dim>
  face_load_values(unsigned int i, unsigned int load_case, const Tractions &tractions) const;
  /// The traction of its resultant among @p tractions; zero if none.
  elasticity::LinearTraction<dim>
  linear_traction(unsigned int i, unsigned int load_case, const Tractions &tractions) const;
  /// Whether loads change in this subdomain when the rest of a face moves.
  bool has_resultants() const;

  bool has_body_force(unsigned int load_case) const;
  /// Body force at the Gauss points of cell i of cells(), with gravity.
  Nodes body_force(unsigned int i, unsigned int load_case) const;
  /// Material of cell i of cells().
  const elasticity::Material     &material(unsigned int i) const;
  const elasticity::Element<dim> &element() const { return the_element; }

private:
  void                  build_pattern();
  const BodyLoads<dim> &loads(unsigned int load_case) const
  {
    return model.load_cases[load_case].bodies[subdomain.body];
  }
  const BoundaryLoad<dim> *boundary_load(unsigned int i, unsigned int load_case) const;

  const mesh::BodyMesh<dim>             &mesh;
  const mesh::Subdomain                 &subdomain;
  const Model<dim>                      &model;
  const elasticity::Element<dim>        &the_element;
  const elasticity::FaceLoad<dim>       &face_load;
  std::vector<unsigned int>              faces; ///< indices of boundary_faces()
  std::vector<mesh::NodeReach<dim>>      cell_reach, face_reach;
  std::vector<std::vector<unsigned int>> node_neighbours;
  /// per cell, slot a and slot b: place of b among a's neighbours
  std::vector<std::vector<unsigned int>> places;
};
} // namespace snug::state

#endif
