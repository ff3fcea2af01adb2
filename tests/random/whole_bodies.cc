#include <snug/app/build_model.h>

#include <random/whole_bodies.h>

#include <cmath>

namespace snug::test {
namespace {
/// Translations and rotations about the mean position, of size 1.
template <int dim>
Matrix rigid_motions(const std::vector<dealii::Tensor<1, dim>> &positions)
{
  dealii::Tensor<1, dim> centre;
  for (const auto &x : positions)
    centre += x / double(positions.size());
  double length = 0.;
  for (const auto &x : positions)
    length = std::max(length, (x - centre).norm());
  const unsigned int n_rotations = dim == 2 ? 1 : 3;
  Matrix             R(dim * positions.size(), dim + n_rotations);
  for (unsigned int a = 0; a < positions.size(); ++a)
    {
      const auto arm = (positions[a] - centre) / length;
      for (unsigned int d = 0; d < dim; ++d)
        R(dim * a + d, d) = 1.;
      // about z in the plane; about x, y and z in space
      for (unsigned int r = 0; r < n_rotations; ++r)
        {
          const unsigned int i = dim == 2 ? 0 : (r + 1) % 3, j = dim == 2 ? 1 : (r + 2) % 3;
          R(dim * a + i, dim + r) = -arm[j];
          R(dim * a + j, dim + r) = arm[i];
        }
    }
  return R;
}
} // namespace

template <int dim>
typename WholeBodies<dim>::Key WholeBodies<dim>::key(unsigned int                  index,
                                                     const dealii::Tensor<1, dim> &x)
{
  Key key{{index}};
  for (unsigned int d = 0; d < dim; ++d)
    key[d + 1] = std::lround(x[d] * 1e7 + 0.2137);
  return key;
}

template <int dim>
WholeBodies<dim>::WholeBodies(scene::Scene scene)
{
  scene.tearing.subdomains = 1;
  std::ostringstream       log;
  RunContext               context(MPI_COMM_SELF, log);
  const auto               mesh    = app::build_mesh<dim>(scene, MPI_COMM_SELF);
  const auto               tearing = mesh::tear(*mesh);
  const auto              &x       = mesh->reference_positions();
  state::StateProblem<dim> state(*mesh, tearing, app::build_model(scene, *mesh), x, context);
  try
    {
      state.set(x, 0);
    }
  catch (const SolveError &)
    {
      // Ignore the equilibrium error: matrices and loads are assembled already.
    }
  collect(state, *mesh, state.rows(x, 0));
}

template <int dim>
void WholeBodies<dim>::collect(const state::StateProblem<dim>    &state,
                               const mesh::BodyMesh<dim>         &mesh,
                               const state::RowCoefficients<dim> &rows)
{
  const auto           &x          = mesh.reference_positions();
  const auto           &of_contact = state.of(0).gluing->contact_of_row();
  const auto           &scales     = state.of(0).gluing->contact_scales();
  const auto            g          = state.of(0).gluing->right_hand_side(rows, 0);
  std::vector<DenseRow> all(of_contact.size());
  if (state.systems.size() != mesh.n_bodies())
    throw std::runtime_error("a body is not in one piece");
  problem.first.push_back(0);
  for (unsigned int s = 0; s < state.systems.size(); ++s)
    {
      const auto                         &nodes = state.tearing.subdomains[s].nodes;
      std::vector<dealii::Tensor<1, dim>> positions;
      for (const unsigned int node : nodes)
        {
          unknown_of_node[key(state.tearing.subdomains[s].body, x[node])] =
            problem.first.back() + dim * positions.size();
          positions.push_back(x[node]);
        }
      std::vector<feti::BEntry> B;
      state.of(0).gluing->fill_B(s, rows, B);
      for (const auto &entry : B)
        all[entry.row].coefficients.emplace_back(problem.first.back() + entry.dof, entry.value);
      collect_body(state.systems[s], state.assemblers[s]->load(x, 0, state.resultants.tractions(x)),
                   positions);
    }
  const auto surface = state.surface.gather(x);
  for (unsigned int i = 0; i < all.size(); ++i)
    {
      const unsigned int contact = of_contact[i];
      const double       scale   = contact < scales.size() ? scales[contact] : 1.;
      all[i].bound               = scale * g(i);
      for (auto &c : all[i].coefficients)
        c.second *= scale;
      if (contact < scales.size())
        {
          const auto &place = state.of(0).contact->places()[contact];
          row_of_slave[key(place.pair, surface[place.slave])] = problem.contact.size();
        }
      (contact < scales.size() ? problem.contact : problem.held).push_back(all[i]);
    }
}

template <int dim>
void WholeBodies<dim>::collect_body(const feti::SubdomainSystem               &system,
                                    const std::vector<double>                 &f,
                                    const std::vector<dealii::Tensor<1, dim>> &positions)
{
  const unsigned int n = system.n_dofs(), first = problem.first.back();
  problem.K.emplace_back(n, n);
  for (unsigned int i = 0; i < n; ++i)
    for (auto k = system.K.row_start()[i]; k < system.K.row_start()[i + 1]; ++k)
      problem.K.back()(i, system.K.columns()[k]) = system.K.values[k];
  problem.rigid.push_back(rigid_motions<dim>(positions));
  problem.first.push_back(first + n);
  problem.f.grow_or_shrink(first + n);
  for (unsigned int i = 0; i < n; ++i)
    problem.f(first + i) = f[i];
}

template class WholeBodies<2>;
template class WholeBodies<3>;
} // namespace snug::test
