#ifndef tests_unit_app_solved_scene_h
#define tests_unit_app_solved_scene_h

#include <snug/app/build_model.h>
#include <snug/base/errors.h>
#include <snug/mesh/tearing.h>
#include <snug/scene/read_scene.h>

#include <functional>
#include <sstream>

namespace snug::test {
/// Settings of states that tests compare.
const std::vector<std::string> exact = {"Solver/Relative tolerance=1e-10"};

inline std::vector<std::string> with(std::vector<std::string> sets)
{
  sets.insert(sets.end(), exact.begin(), exact.end());
  return sets;
}

/// A rigid motion or scaling of a whole scene: x -> factor Q x + shift.
template <int dim>
struct Motion
{
  dealii::Tensor<2, dim> Q = dealii::unit_symmetric_tensor<dim>();
  dealii::Tensor<1, dim> shift;
  double                 factor = 1.;

  dealii::Tensor<1, dim> turned(const dealii::Tensor<1, dim> &v) const { return Q * v; }

  dealii::Tensor<1, dim> moved(const dealii::Tensor<1, dim> &x) const
  {
    return factor * (Q * x) + shift;
  }
};

/// A turn about two axes and a shift.
inline Motion<3> some_motion()
{
  Motion<3>            motion;
  dealii::Tensor<2, 3> a = motion.Q, b = motion.Q;
  a[0][0] = a[1][1] = std::cos(0.7);
  a[1][0]           = std::sin(0.7);
  a[0][1]           = -a[1][0];
  b[1][1] = b[2][2] = std::cos(-1.1);
  b[2][1]           = std::sin(-1.1);
  b[1][2]           = -b[2][1];
  motion.Q          = a * b;
  motion.shift      = dealii::Point<3>(3., -2., 5.);
  return motion;
}

/// The state of a parameter file without the program around it, with all
/// its bodies and obstacles moved.
template <int dim>
class SolvedScene
{
public:
  SolvedScene(const std::string              &text,
              const std::vector<std::string> &sets   = {},
              const Motion<dim>              &motion = {})
    : scene(scene::read_scene({"scene.prm", text, sets, "", contents}))
    , context(MPI_COMM_WORLD, log)
    , mesh(MPI_COMM_WORLD,
           app::mesh_parameters(scene),
           scene.degree,
           scene::idealization(scene),
           scene.tearing)
    , tearing(mesh::tear(mesh))
    , model(moved_model(motion))
    , positions(moved_positions(motion))
    , solver(mesh, tearing, model, positions, context)
    , state(solver.solve(positions, qp::WarmStart()))
  {}

  /// Force on the slave side of pair @p p.
  dealii::Tensor<1, dim> force(unsigned int p) const { return state.pairs[p].force; }

  const scene::Scene                  scene;
  std::ostringstream                  log;
  RunContext                          context;
  mesh::BodyMesh<dim>                 mesh;
  mesh::Tearing                       tearing;
  state::Model<dim>                   model;
  typename mesh::BodyMesh<dim>::Field positions;
  state::StateSolver<dim>             solver;
  state::ContactState<dim>            state;

private:
  static std::string contents(const std::string &file) { return scene::read_text(file); }

  static std::vector<double> to_list(const dealii::Tensor<1, dim> &v)
  {
    std::vector<double> list(dim);
    for (unsigned int c = 0; c < dim; ++c)
      list[c] = v[c];
    return list;
  }

  state::Model<dim> moved_model(const Motion<dim> &motion) const
  {
    auto       model = app::build_model(scene, mesh);
    const auto read  = [](const std::vector<double> &list) {
      return dealii::Tensor<1, dim>(contact::to_point<dim>(list));
    };
    for (auto &load_case : model.load_cases)
      for (auto &body : load_case.bodies)
        if (body.body_force)
          body.body_force = [=, force = body.body_force](const auto &x) {
            return motion.turned(force(x)) / motion.factor;
          };
    for (auto &pair : model.pairs)
      if (pair.obstacle)
        {
          auto &obstacle = *pair.obstacle;
          obstacle.point = to_list(motion.moved(read(obstacle.point)));
          obstacle.radius *= motion.factor;
          for (auto *direction : {&obstacle.normal, &obstacle.axis})
            *direction = to_list(motion.turned(read(*direction)));
          obstacle.displacement =
            to_list(motion.factor * motion.turned(read(obstacle.displacement)));
        }
    return model;
  }

  typename mesh::BodyMesh<dim>::Field moved_positions(const Motion<dim> &motion) const
  {
    auto x = mesh.reference_positions();
    for (auto &position : x)
      position = motion.moved(position);
    return x;
  }
};

/// The message of the SolveError that solving @p text ends with, or "".
inline std::string error_of_solving(const std::string &text)
{
  try
    {
      SolvedScene<2> solved(text);
    }
  catch (const SolveError &error)
    {
      return error.what();
    }
  return "";
}
} // namespace snug::test

#endif
