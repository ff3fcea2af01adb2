#ifndef snug_io_contact_output_h
#define snug_io_contact_output_h

#include <snug/contact/contact.h>
#include <snug/mesh/surface.h>
#include <snug/scene/output_parameters.h>
#include <snug/state/contact_state.h>

#include <string>
#include <utility>
#include <vector>

namespace snug::io {
/**
 * The series contact.pvd of contact faces. State number i is contact-000i.vtm with a block per
 * boundary of both sides, undeformed, in the position of the load case, and contact-000i.pvtu with
 * all of them, see write_state(). The table of the contact rows is contact-000i.csv. Rank 0 writes.
 *
 * | field               | meaning                          | units           |
 * |---------------------|----------------------------------|-----------------|
 * | pressure            | force / area                     | force/length^2* |
 * | gap                 | gap after deformation            | length          |
 * | force               | force of the contact row         | force           |
 * | area                | tributary area                   | length^2*       |
 * | active, weak        | 1 or 0                           |                 |
 * | candidate           | 1 where there is a row, else 0   |                 |
 * | slave               | 1 on the slave side, else 0      |                 |
 * | pair                | first pair of slave face, or -1  | index           |
 * | body                | index of `Bodies`                |                 |
 * | displacement        | displacement                     | length          |
 * | design_displacement | design minus reference           | length          |
 *
 * With friction also:
 *
 * | field               | meaning                                          | units           |
 * |---------------------|--------------------------------------------------|-----------------|
 * | traction            | friction force on the slave side / area          | force/length^2* |
 * | slip                | of the slave side over the master, in this step  | length          |
 * | friction            | 0 none, 1 open, 2 stick, 3 slip                  |                 |
 *
 * With tied pairs also, at nodes of their slave sides, zero elsewhere:
 *
 * | field               | meaning                                          | units           |
 * |---------------------|--------------------------------------------------|-----------------|
 * | tie_tension         | normal traction, negative: pressure               | force/length^2* |
 * | tie_shear           | shear traction on the slave side                 | force/length^2* |
 *
 * (*) length in 2D, where forces are per unit thickness.
 *
 * Pressure, gap and flags are given at slave nodes. Hanging nodes interpolate pressure and gap,
 * and are active or weak if all their masters are. The same holds for nodes without a row for
 * which other rows act (mortar). At all other nodes they are 0. A node of several pairs has one
 * point in each pair. In the table a row has the pair with the maximum share in the row.
 * The table also has the numbers of the slave nodes in bodies.msh and bodies.inp, the unit outward
 * normals of the slave side and, in 2D, arc_length, the length along the undeformed boundary from
 * its begin. Its rows are sorted by pair and along the boundaries. Tied pairs have a table of their
 * own, ties-000i.csv.
 */
template <int dim>
class ContactOutput
{
public:
  /// Mesh and contact of a state.
  struct Sources
  {
    const mesh::BodyMesh<dim>                       &mesh;
    const mesh::Surface<dim>                        &surface;
    const std::vector<contact::JoinedPair>          &pairs;
    const std::vector<contact::RowPlace>            &places;
    const std::vector<contact::DependentMultiplier> &dependent_multipliers;
    const contact::PlacedSurface<dim>               &placed;
    /// WholeMesh::number_of, on rank 0; not used if there are no rows
    const std::vector<unsigned int> &number_of;
    /// pairing of tied pairs, or nullptr
    const contact::Contact<dim> *ties = nullptr;
  };

  /// Files go to the directory @p directory, which must exist. Blocks have the @p body_names.
  ContactOutput(const std::string              &directory,
                const scene::OutputParameters  &parameters,
                const std::vector<std::string> &body_names)
    : directory(directory), compression(parameters.compression), body_names(body_names)
  {}

  /// Add @p state to the series with the time @p time, and return the name of its file.
  /// Collective.
  /// @throws std::runtime_error if a file cannot be written.
  std::string write(const Sources &of, double time, const state::ContactState<dim> &state);

private:
  std::string                                 directory;
  unsigned int                                compression;
  std::vector<std::string>                    body_names;
  std::vector<std::pair<double, std::string>> series;
};

} // namespace snug::io

#endif
