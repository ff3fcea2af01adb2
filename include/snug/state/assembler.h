#ifndef snug_state_assembler_h
#define snug_state_assembler_h

#include <snug/elasticity/face_load.h>
#include <snug/feti/subdomain_system.h>
#include <snug/mesh/node_reach.h>
#include <snug/mesh/tearing.h>
#include <snug/state/concentrated_loads.h>
#include <snug/state/resultant_loads.h>

namespace snug::state {
/**
 * This class assembles one subdomain. The subdomain has dim unknowns per node of Subdomain::nodes.
 * Cells with hanging nodes act on the masters, K_e -> T' K_e T; the four cells of a tetrahedron do
 * so together, unless the formulation acts in each cell. The subdomain of a reference point has its
 * motion as unknowns (ReferencePoints), K = 0, and R = I.
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
            const elasticity::FaceLoad<dim> &face_load,
            const ConcentratedLoads<dim>    &concentrated);

  unsigned int n_dofs() const
  {
    return is_point() ? mesh.idealization().n_rigid_motions() : dim * subdomain.nodes.size();
  }

  /// Return whether the subdomain is that of a reference point.
  bool is_point() const { return subdomain.cells.empty(); }

  /// Return the sparsity pattern of K.
  feti::CsrMatrix sparsity() const;

  /// Compute K at the given positions of the local nodes.
  void stiffness(const Field &positions, feti::CsrMatrix &K) const;

  /// Return f of a load case at the given positions, with the tractions of resultants at these
  /// positions.
  std::vector<double>
  load(const Field &positions, unsigned int load_case, const Tractions &tractions) const;

  /**
   * Compute rigid body modes at the unknowns. R contains orthonormal modes, computed from
   * rigid_motions() about the centre of the subdomain. Z is such that R Z contains the modes of the
   * body, which are rigid_motions() about @p centre over @p length.
   */
  void rigid_modes(const Field                  &positions,
                   const dealii::Tensor<1, dim> &centre,
                   double                        length,
                   qp::MultiVector              &R,
                   qp::MultiVector              &Z) const;

  /// Return the unknowns of far-apart nodes (farthest point sampling) that rigid motions move.
  std::vector<unsigned int> fixing_dofs(const Field &positions) const;

  /// Return whether the subdomain is nearly a cube (a square in the plane) of cells near cubes of
  /// one size and material. In this case no motion is much softer than the neighbouring subdomains.
  bool is_compact(const Field &positions) const;

  /// Return the mesh indices of the cells and of the loaded boundary faces of the subdomain.
  const std::vector<unsigned int> &cells() const { return subdomain.cells; }
  const std::vector<unsigned int> &loaded_faces() const { return faces; }

  /// @name Pieces of the cells, which are tetrahedra or single cells, for integrals over all of
  /// them
  /// @{
  unsigned int n_pieces() const { return pieces.size(); }
  /// Return the first cell of piece i, index into cells(). The cells of a piece have one material.
  unsigned int cell_of_piece(unsigned int i) const { return pieces[i].cell; }
  /// Return the Gauss points of all cells of piece i, with the functions of its nodes.
  const std::vector<mesh::LagrangePoint<dim>> &piece_points(unsigned int i) const
  {
    return pieces[i].tetrahedron ? the_element.points_of_tetrahedron() : the_element.points();
  }
  /// Return the values of a nodal field, or of the subdomain vector u, at the nodes of piece i.
  Nodes piece_field(unsigned int i, const Field &field) const
  {
    return piece_field(pieces[i], field);
  }
  Nodes piece_values(unsigned int i, const double *u) const;
  /// Return the thermal strain at the points of piece i; empty if there is none.
  elasticity::ThermalStrain<dim> piece_strain(unsigned int i, unsigned int load_case) const;
  /// @}

  /// Return the values of a nodal field at the nodes of cell i of cells().
  Nodes cell_field(unsigned int i, const Field &field) const;
  /// Return the values of the subdomain vector u at the nodes of cell i.
  Nodes cell_values(unsigned int i, const double *u) const { return cell_reach[i].values(u); }
  /// Add factor * T' r of cell i to u.
  void add_cell_vector(unsigned int i, double factor, const Nodes &r, double *u) const;

  /// Return or add the same quantities for loaded face i of loaded_faces().
  Nodes face_field(unsigned int i, const Field &field) const;
  Nodes face_values(unsigned int i, const double *u) const { return face_reach[i].values(u); }
  void  add_face_vector(unsigned int i, double factor, const Nodes &r, double *u) const;
  /// Return the loads of face i of loaded_faces() in a load case.
  elasticity::FaceLoadValues<dim>
  face_load_values(unsigned int i, unsigned int load_case, const Tractions &tractions) const;
  /// Return the traction of the resultant of face i among @p tractions; zero if it has none.
  elasticity::LinearTraction<dim>
  linear_traction(unsigned int i, unsigned int load_case, const Tractions &tractions) const;
  /// Return whether loads change in this subdomain when the rest of a loaded boundary moves.
  bool has_resultants() const;

  /// @name Loads of cell i of cells() at its node positions X: body forces, gravity and thermal
  /// strains
  /// @{
  bool  has_cell_loads(unsigned int load_case) const;
  Nodes cell_load(unsigned int i, const Nodes &X, unsigned int load_case) const;
  /// Return the derivative of cell_load() along V, exact.
  Nodes cell_load_derivative(unsigned int i,
                             const Nodes &X,
                             const Nodes &V,
                             unsigned int load_case) const;
  /// Add factor * d/dX (cell_load . w) to the gradient.
  void add_cell_load_gradient(unsigned int i,
                              const Nodes &X,
                              unsigned int load_case,
                              const Nodes &w,
                              double       factor,
                              Nodes       &gradient) const;
  /// Return the thermal strain; empty if there is none.
  elasticity::ThermalStrain<dim> thermal_strain(unsigned int i, unsigned int load_case) const;
  /// @}

  /// Return the material of cell i of cells().
  const elasticity::Material     &material(unsigned int i) const;
  const elasticity::Element<dim> &element() const { return the_element; }

private:
  /// A part of the cells whose stiffness is computed at once: a cell or a tetrahedron.
  struct Piece
  {
    unsigned int              cell; ///< the first cell, index into cells()
    const mesh::Tetrahedron  *tetrahedron;
    std::vector<unsigned int> places; ///< slot a and slot b: place of b among the neighbours of a
  };

  std::vector<double> point_load(unsigned int load_case) const;

  void  collect_pieces();
  Nodes piece_field(const Piece &piece, const Field &field) const;
  void  build_pattern();
  void
  compute_stiffness(const Piece &piece, const Field &positions, std::vector<double> &matrix) const;
  bool has_body_force(unsigned int load_case) const;
  /// Return the body force at the Gauss points of cell i, including gravity.
  Nodes                 body_force(unsigned int i, unsigned int load_case) const;
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
  const ConcentratedLoads<dim>          &concentrated;
  std::vector<unsigned int>              faces; ///< indices into boundary_faces()
  std::vector<mesh::NodeReach<dim>>      cell_reach, face_reach;
  std::vector<Piece>                     pieces;
  std::vector<std::vector<unsigned int>> node_neighbours;
};
} // namespace snug::state

#endif
