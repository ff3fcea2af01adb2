#ifndef snug_io_fields_h
#define snug_io_fields_h

#include <snug/contact/placed_surface.h>
#include <snug/mesh/tearing.h>
#include <snug/scene/output_parameters.h>
#include <snug/state/assembler.h>
#include <snug/state/contact_state.h>

#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/**
 * The series solution.pvd of fields on the bodies and on their boundaries. State number i is
 * solution-000i.vtm with a block per body and per boundary, see write_state(), and
 * solution-000i.pvtu with all bodies. OutputParameters give the number of ranks per file.
 *
 * Points lie on the design in the position of the load case, before deformation: "warp by vector
 * displacement" shows the deformed bodies, and warping by minus design_displacement shows the
 * reference bodies. Cells share points within each region of a body. A mesh::Tetrahedron is one
 * quadratic tetrahedron of VTK, with the error of its four cells.
 *
 * | field               | components | units                |
 * |---------------------|------------|----------------------|
 * | displacement        | 3          | length               |
 * | stress              | 6          | force / length^2     |
 * | von_mises           | 1          | force / length^2     |
 * | principal_stress    | 3          | force / length^2     |
 * | body                | 1          | index of `Bodies`    |
 * | design_displacement | 3          | length               |
 * | shape_gradient      | 3          | objective / length   |
 * | region, of cells    | 1          | index in the body    |
 * | subdomain, of cells | 1          | global id            |
 * | error, of cells     | 1          | (force length)^(1/2) |
 *
 * The stress is smoothed by nodal_stress(). The von Mises stress and the principal stresses
 * (maximum, middle, minimum) are those of the smoothed stress. In 2D the component ZZ is the stress
 * across the section, which is the hoop stress if axisymmetric. Boundaries show the values of their
 * cells.
 */
template <int dim>
class FieldOutput
{
public:
  /// Mesh and bodies of a state. The mesh may differ from the mesh of the state before.
  struct Sources
  {
    const mesh::BodyMesh<dim>                &mesh;
    const mesh::Tearing                      &tearing;
    const std::vector<state::BodyModel<dim>> &bodies; ///< materials and formulations
    const state::LoadCase<dim>               &load_case;
  };

  /// Files go to the directory @p directory, which must exist. Blocks have the @p body_names.
  FieldOutput(const std::string              &directory,
              const scene::OutputParameters  &parameters,
              const std::vector<std::string> &body_names)
    : directory(directory), parameters(parameters), body_names(body_names)
  {}

  /**
   * Add @p state to the series with the time @p time, for example the number of the design
   * iteration. Collective.
   * @param[in] shape_gradient dJ/dX at the local nodes, including hanging nodes, as shares that
   * add up over ranks; null: not written.
   * @param[in] errors estimated errors of the cells; null: not written.
   * @return the name of the file that lists the blocks.
   * @throws std::runtime_error if a file cannot be written.
   */
  std::string write(const Sources                             &of,
                    double                                     time,
                    const state::ContactState<dim>            &state,
                    const typename mesh::BodyMesh<dim>::Field *shape_gradient = nullptr,
                    const std::vector<double>                 *errors         = nullptr);

private:
  std::string                                 directory;
  scene::OutputParameters                     parameters;
  std::vector<std::string>                    body_names;
  std::vector<std::pair<double, std::string>> series;
};
} // namespace snug::io

#endif
