#include <snug/state/resultant_loads.h>

#include <set>

namespace snug::state {
namespace {
/// Sum the moments over ranks in one reduction for all boundaries.
template <int dim>
void add_up(std::vector<elasticity::AreaMoments<dim>> &moments, MPI_Comm comm)
{
  const unsigned int  n = 1 + dim + dim * dim;
  std::vector<double> values;
  for (const auto &of : moments)
    {
      values.push_back(of.area);
      for (unsigned int c = 0; c < dim; ++c)
        values.push_back(of.first[c]);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          values.push_back(of.second[c][d]);
    }
  MPI_Allreduce(MPI_IN_PLACE, values.data(), values.size(), MPI_DOUBLE, MPI_SUM, comm);
  for (unsigned int i = 0; i < moments.size(); ++i)
    {
      const double *value = &values[n * i];
      moments[i].area     = *value++;
      for (unsigned int c = 0; c < dim; ++c)
        moments[i].first[c] = *value++;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          moments[i].second[c][d] = *value++;
    }
}
} // namespace

template <int dim>
ResultantLoads<dim>::ResultantLoads(const mesh::BodyMesh<dim>        &mesh,
                                    const elasticity::FaceLoad<dim>  &face_load,
                                    const std::vector<LoadCase<dim>> &load_cases)
  : mesh(mesh), face_load(face_load), load_cases(load_cases)
{
  // Use a set, so that the boundaries have one order on all ranks, because sums over ranks rely on
  // it.
  std::set<Boundary> boundaries;
  for (const auto &load_case : load_cases)
    for (unsigned int b = 0; b < load_case.bodies.size(); ++b)
      for (const auto &entry : load_case.bodies[b].boundaries)
        if (entry.second.has_resultant())
          boundaries.emplace(b, entry.first);
  for (const auto &boundary : boundaries)
    {
      loaded.push_back({boundary, {}, {}});
      // Take faces of owned cells. Each face is on one rank, so sums over ranks count it once.
      for (unsigned int f = 0; f < mesh.boundary_faces().size(); ++f)
        if (mesh.boundary_faces()[f].body == boundary.first &&
            mesh.boundary_faces()[f].boundary == boundary.second)
          loaded.back().faces.push_back(f);
    }
  const auto &X = mesh.reference_positions();
  // The origins are still zero, which gives the centroid of the reference geometry. Moments about a
  // point far from the boundary would make I a difference of large numbers.
  const auto about = moments([&](unsigned int f, const auto &origin) {
    return this->face_load.moments(at_face(f, X), origin);
  });
  for (unsigned int i = 0; i < loaded.size(); ++i)
    loaded[i].origin = about[i].first / about[i].area;
}

template <int dim>
typename ResultantLoads<dim>::Nodes ResultantLoads<dim>::at_face(unsigned int face,
                                                                 const Field &field) const
{
  Nodes values;
  for (const unsigned int node : mesh.boundary_faces()[face].nodes)
    values.push_back(field[node]);
  return values;
}

/// Return the sums of compute(face, origin) over each boundary.
template <int dim>
template <typename Compute>
std::vector<elasticity::AreaMoments<dim>> ResultantLoads<dim>::moments(const Compute &compute) const
{
  std::vector<Moments> result(loaded.size());
  for (unsigned int i = 0; i < loaded.size(); ++i)
    for (const unsigned int f : loaded[i].faces)
      {
        const Moments of_face = compute(f, loaded[i].origin);
        result[i].area += of_face.area;
        result[i].first += of_face.first;
        result[i].second += of_face.second;
      }
  // The condition is the same on all ranks, because load cases are.
  if (!loaded.empty())
    add_up<dim>(result, mesh.communicator());
  return result;
}

/// Return the spread resultants of each load case, by index into loaded.
template <int dim>
std::vector<std::map<unsigned int, elasticity::SpreadResultant<dim>>>
ResultantLoads<dim>::spread(const Field &positions) const
{
  const auto about = moments([&](unsigned int f, const auto &origin) {
    return face_load.moments(at_face(f, positions), origin);
  });
  std::vector<std::map<unsigned int, Spread>> result(load_cases.size());
  for (unsigned int c = 0; c < load_cases.size(); ++c)
    for (unsigned int i = 0; i < loaded.size(); ++i)
      {
        const auto &boundary   = loaded[i].boundary;
        const auto &boundaries = load_cases[c].bodies[boundary.first].boundaries;
        const auto  found      = boundaries.find(boundary.second);
        if (found != boundaries.end() && found->second.has_resultant())
          result[c].emplace(i, Spread(found->second.resultant, about[i], loaded[i].origin));
      }
  return result;
}

template <int dim>
typename ResultantLoads<dim>::Tractions ResultantLoads<dim>::tractions(const Field &positions) const
{
  const auto now = spread(positions);
  Tractions  result(now.size());
  for (unsigned int c = 0; c < now.size(); ++c)
    for (const auto &entry : now[c])
      result[c][loaded[entry.first].boundary] = entry.second.traction();
  return result;
}

template <int dim>
typename ResultantLoads<dim>::Tractions
ResultantLoads<dim>::traction_derivatives(const Field &positions, const Field &velocity) const
{
  const auto now = spread(positions);
  // A', c' and I' are sums over the whole boundary, so a node changes the traction on all of it.
  const auto changes = moments([&](unsigned int f, const auto &origin) {
    return face_load.moment_derivatives(at_face(f, positions), at_face(f, velocity), origin);
  });
  Tractions  result(now.size());
  for (unsigned int c = 0; c < now.size(); ++c)
    for (const auto &entry : now[c])
      result[c][loaded[entry.first].boundary] = entry.second.derivative(changes[entry.first]);
  return result;
}

/// Differentiate f . u = F . U / A + M . y with U = int u dA and y = I^-1 int r x u dA over the
/// whole boundary. A first pass sums U and the moment over all ranks. A second pass adds the
/// derivatives of these sums and of the positions of the faces.
template <int dim>
void ResultantLoads<dim>::add_work_gradient(unsigned int load_case,
                                            const Field &positions,
                                            const Field &displacement,
                                            double       factor,
                                            Field       &gradient) const
{
  const auto all = spread(positions);
  for (const auto &entry : all[load_case])
    {
      const auto &of  = loaded[entry.first];
      const auto &now = entry.second;
      // U in the first dim numbers, the moment about c in the last three
      double sum[] = {0., 0., 0., 0., 0., 0.};
      for (const unsigned int f : of.faces)
        {
          const auto moved =
            face_load.displacement_moments(at_face(f, positions), at_face(f, displacement),
                                           now.traction().centre);
          for (unsigned int c = 0; c < dim; ++c)
            sum[c] += moved.force[c];
          for (unsigned int c = 0; c < 3; ++c)
            sum[3 + c] += moved.moment[c];
        }
      MPI_Allreduce(MPI_IN_PLACE, sum, 6, MPI_DOUBLE, MPI_SUM, mesh.communicator());
      elasticity::ResultantWork<dim> work;
      dealii::Tensor<1, 3>           moment;
      for (unsigned int c = 0; c < dim; ++c)
        work.displacement[c] = sum[c];
      for (unsigned int c = 0; c < 3; ++c)
        moment[c] = sum[3 + c];
      work.traction = now.traction();
      work.area     = now.area();
      work.rotation = now.divided_by_inertia(moment);
      for (const unsigned int f : of.faces)
        {
          Nodes values(mesh.boundary_faces()[f].nodes.size());
          face_load.add_resultant_gradient(at_face(f, positions), work, at_face(f, displacement),
                                           factor, values);
          for (unsigned int a = 0; a < values.size(); ++a)
            gradient[mesh.boundary_faces()[f].nodes[a]] += values[a];
        }
    }
}

template class ResultantLoads<2>;
template class ResultantLoads<3>;
} // namespace snug::state
