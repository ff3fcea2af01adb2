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
 * The series contact.pvd of contact faces: state number i is
 * contact-000i.vtu (all faces of both sides, undeformed) with a table of
 * the contact rows beside it, contact-000i.csv. Rank 0 writes.
 *
 * | field               | meaning                       | units           |
 * |---------------------|-------------------------------|-----------------|
 * | pressure            | force / area                  | force/length^2* |
 * | gap                 | left after deformation        | length          |
 * | force               | of the contact row            | force           |
 * | area                | tributary                     | length^2*       |
 * | active, weak        | 1 or 0                        |                 |
 * | candidate           | 1 where there is a row        |                 |
 * | slave               | 1 on the slave side, else 0   |                 |
 * | pair                | of the slave face, first; -1  | index           |
 * | body                | index of `Bodies`             |                 |
 * | displacement        |                               | length          |
 * | design_displacement | design minus reference        | length          |
 *
 * (*) length in 2D, where forces are per unit thickness.
 *
 * Pressure, gap and flags stand at slave nodes; hanging ones interpolate
 * pressure and gap and are active or weak where all their masters are; so
 * do nodes that the rows of others act for (mortar). Elsewhere they are 0.
 * A node of several pairs has a point in each. In the table a row has the
 * pair with the largest share in it.
 */
template <int dim>
class ContactOutput
{
public:
  /// What a state is of.
  struct Sources
  {
    const mesh::BodyMesh<dim>              &mesh;
    const mesh::Surface<dim>               &surface;
    const std::vector<contact::JoinedPair> &pairs;
    const std::vector<contact::RowPlace>   &places;
    const std::vector<contact::SharedNode> &shared_nodes;
  };

  /// Files go to @p directory, which must exist.
  ContactOutput(const std::string &directory, const scene::OutputParameters &parameters)
    : directory(directory), compression(parameters.compression)
  {}

  /// Add @p state to the series as that of @p time. Collective.
  /// @throws std::runtime_error if a file cannot be written.
  void write(const Sources &of, double time, const state::ContactState<dim> &state);

private:
  std::string                                 directory;
  unsigned int                                compression;
  std::vector<std::pair<double, std::string>> series;
};
} // namespace snug::io

#endif
