#include <snug/state/rigid_modes.h>
#include <snug/state/subdomain_table.h>

#include <algorithm>
#include <cmath>

namespace snug::state {
namespace {
/// Return orthonormal rigid motions of the nodes of a face at @p x. Stretching motions of the face
/// besides them would save 5 to 8 percent of the F-mults, and joints at edges would save none.
template <int dim>
qp::MultiVector motions_of_face(const mesh::Idealization &idealization, const mesh::Field<dim> &x)
{
  dealii::Tensor<1, dim> mean;
  for (const auto &point : x)
    mean += point / static_cast<double>(x.size());
  double radius = 0.;
  for (const auto &point : x)
    radius = std::max(radius, (point - mean).norm());
  auto result = rigid_motions<dim>(idealization, x, mean, radius);
  orthonormalise(result);
  return result;
}
} // namespace

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
  if (tearing.clusters.of_subdomain.empty())
    return table;
  table.compares_soft_modes = !tearing.clusters.is_chosen;
  table.clusters            = tearing.clusters.of_subdomain;
  for (unsigned int s = 0; s < table.clusters.size(); ++s)
    if (table.clusters[s] == table.first_subdomains.size())
      table.first_subdomains.push_back(s);
  // The motion of a reference point is a cluster by itself.
  for (auto s = narrow<unsigned int>(table.clusters.size()); s < tearing.n_global; ++s)
    {
      table.clusters.push_back(narrow<unsigned int>(table.first_subdomains.size()));
      table.first_subdomains.push_back(s);
    }
  table.joints.resize(tearing.subdomains.size());
  for (unsigned int s = 0; s < tearing.clusters.joints.size(); ++s)
    for (const auto &joint : tearing.clusters.joints[s])
      {
        mesh::Field<dim> x;
        table.joints[s].push_back({joint.other, {}, qp::MultiVector()});
        for (const unsigned int node : joint.nodes)
          {
            x.push_back(mesh.reference_positions()[tearing.subdomains[s].nodes[node]]);
            for (unsigned int c = 0; c < dim; ++c)
              table.joints[s].back().dofs.push_back(dim * node + c);
          }
        table.joints[s].back().motions = motions_of_face<dim>(mesh.idealization(), x);
      }
  return table;
}

template feti::SubdomainTable
subdomain_table(const mesh::BodyMesh<2> &, const mesh::Tearing &, const Model<2> &);
template feti::SubdomainTable
subdomain_table(const mesh::BodyMesh<3> &, const mesh::Tearing &, const Model<3> &);
} // namespace snug::state
