#include <snug/state/subdomain_table.h>

namespace snug::state {
template <int dim>
feti::SubdomainTable subdomain_table(const mesh::BodyMesh<dim> &mesh,
                                     const mesh::Tearing       &tearing,
                                     const Model<dim>          &model)
{
  feti::SubdomainTable table;
  table.n_modes    = mesh.idealization().n_rigid_motions();
  table.first      = tearing.first_id;
  table.body_names = model.body_names;
  for (const auto &point : model.points)
    table.body_names.push_back(point.name + " (reference point)");
  table.n_rigid = tearing.n_points;
  table.body.assign(tearing.n_global, 0);
  for (unsigned int s = 0; s < tearing.subdomains.size(); ++s)
    table.body[tearing.first_id + s] = tearing.subdomains[s].body;
  // Each subdomain has one rank, and the other ranks contribute 0, so the maximum is its body.
  MPI_Allreduce(MPI_IN_PLACE, table.body.data(), table.body.size(), MPI_UNSIGNED, MPI_MAX,
                mesh.communicator());
  return table;
}

template feti::SubdomainTable
subdomain_table(const mesh::BodyMesh<2> &, const mesh::Tearing &, const Model<2> &);
template feti::SubdomainTable
subdomain_table(const mesh::BodyMesh<3> &, const mesh::Tearing &, const Model<3> &);
} // namespace snug::state
