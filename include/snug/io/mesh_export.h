#ifndef snug_io_mesh_export_h
#define snug_io_mesh_export_h

#include <snug/io/whole_mesh.h>
#include <snug/scene/scene.h>
#include <snug/state/state_solver.h>

namespace snug::io {
/// Return the name "body.boundary" of a boundary.
template <int dim>
std::string boundary_name(const mesh::BodyMesh<dim> &mesh,
                          const scene::Scene        &scene,
                          unsigned int               body,
                          unsigned int               boundary);

/// Return the name of the cells of a region of a body: "body", or "body.region" if the body has
/// cells of several regions.
template <int dim>
std::string region_name(const mesh::BodyMesh<dim> &mesh,
                        const scene::Scene        &scene,
                        const WholeMesh<dim>      &whole,
                        unsigned int               body,
                        unsigned int               region);

/**
 * Return a mesh as the text of a file of Gmsh (.msh 2.2, ASCII), with all digits of the positions.
 * Physical groups are the regions and boundaries of the bodies. Elements of degree 2 have 9 or 27
 * nodes. Hanging nodes would be nodes of the boundary, so there must be none. For rank 0. Source:
 * Gmsh reference manual, file formats.
 */
template <int dim>
std::string
msh_text(const mesh::BodyMesh<dim> &mesh, const scene::Scene &scene, const WholeMesh<dim> &whole);

/// A deck, and the parts of the model that the deck does not contain.
struct DeckExport
{
  std::string              text;
  std::vector<std::string> left_out;
};

/**
 * Return the model of the first load case as a deck of CalculiX (.inp) in one static step: C3D8,
 * C3D20, CPE4 and the like, materials, *EQUATION for hanging nodes, supports and prescribed
 * displacements, loads, and contact pairs with a penalty of @p penalty times Young's modulus over
 * the face size. Constant pressures and gravity are *DSLOAD and *DLOAD; if there are other loads,
 * all loads are the nodal forces of @p whole. @p frames are the held directions at the positions of
 * the mesh. For rank 0. Source: CalculiX CrunchiX user's manual.
 */
template <int dim>
DeckExport deck_text(const state::StateSolver<dim>                              &solver,
                     const scene::Scene                                         &scene,
                     const WholeMesh<dim>                                       &whole,
                     const typename supports::DirichletConstraints<dim>::Frames &frames);
} // namespace snug::io

#endif
