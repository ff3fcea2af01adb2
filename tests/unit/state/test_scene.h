#ifndef snug_tests_unit_state_test_scene_h
#define snug_tests_unit_state_test_scene_h

#include <snug/state/state_solver.h>

#include <cmath>
#include <limits>
#include <random>
#include <sstream>

namespace snug::test {
/// Index of a box face: axis 0 is x, side 0 the lower one.
inline unsigned int face_index(unsigned int axis, unsigned int side)
{
  return 2 * axis + side;
}

/// A box, its bottom a sphere (2D: circle) of a radius that touches the
/// flat bottom at its centre, refined once where x of the flat box is
/// below a value, of another material where x is above another.
template <int dim>
struct TestBody
{
  struct Load
  {
    double                     pressure = 0.;
    dealii::Tensor<1, dim>     traction;
    elasticity::Resultant<dim> resultant;
    /// forces at points and along lines
    std::vector<state::PlacedForce<dim>> concentrated = {};
    /// pressure and traction vary by this factor of the reference position
    std::function<double(const dealii::Point<dim> &)> factor = {};
  };
  using Loads = std::map<unsigned int, Load>;

  dealii::Point<dim>        corner, size;
  std::vector<unsigned int> cells;
  double                    radius        = 0.;    ///< 0: flat
  bool                      sampled       = false; ///< contact sees the circle, not facets
  double                    refined_below = 0.;
  elasticity::Material      material{1000., 0.3, 0., 0., 25.};
  elasticity::Material      core{50., 0.4}; ///< of coarse cells beyond
  double                    core_from   = std::numeric_limits<double>::max();
  elasticity::Formulation   formulation = elasticity::Formulation::standard;
  dealii::Tensor<1, dim>    body_force;
  /// above the unstressed body, as a function of the reference position
  std::function<double(const dealii::Point<dim> &)> temperature = {};
  Loads                                             loads;
  /// boundary -> (component or dim: the normal, stiffness per area)
  std::map<unsigned int, std::vector<std::pair<unsigned int, double>>> springs;
  /// boundary -> fixed components, dim: the normal
  std::map<unsigned int, std::vector<unsigned int>> supports;
  /// prescribed displacements; the scene fills in the body
  std::vector<supports::Support<dim>> prescribed;
};

/**
 * Punch (body 0) on foundation (body 1): bottom on top. The foundation's
 * top is moved up by Bernstein heights, carried down linearly.
 */
template <int dim>
struct TestScene
{
  std::vector<TestBody<dim>> bodies;
  mesh::Idealization         idealization = mesh::Idealization::natural(dim);
  /// contacts and tied pairs; if empty, the punch's bottom on the foundation's top
  std::vector<contact::Pair> pairs;
  contact::Method            method         = contact::Method::nodal;  ///< of that pair
  contact::Friction          friction       = contact::Friction::none; ///< of that pair
  std::string                friction_value = "0";                     ///< its coefficient or bound
  unsigned int               degree         = 1;
  std::vector<unsigned int>  control_points = {1, 1};
  std::vector<double>        design         = {0.};
  qp::SolverParameters       solver{"active set", 1e-10, 5000};
  feti::FetiParameters       feti;
  unsigned int               subdomains   = 6;
  unsigned int               cluster_edge = 0;     ///< see mesh::find_clusters()
  bool                       punch_slides = false; ///< nothing holds it horizontally
  /// [case][body]; empty: one case with the loads of the bodies
  std::vector<std::vector<typename TestBody<dim>::Loads>> cases;
  bool are_steps = false; ///< each case continues the slips of the one before
};

/// Height of the design at box fractions (s, t) of the top.
inline double bezier_height(const std::vector<unsigned int> &n,
                            const std::vector<double>       &alpha,
                            double                           s,
                            double                           t)
{
  const auto bernstein = [](unsigned int n_points, unsigned j, double x) {
    double value = 1.;
    for (unsigned int i = 0; i < j; ++i)
      value *= x * (n_points - 1. - i) / (i + 1.);
    return value * std::pow(1. - x, int(n_points - 1 - j));
  };
  double height = 0.;
  for (unsigned int i = 0; i < alpha.size(); ++i)
    height += alpha[i] * bernstein(n[0], i % n[0], s) * bernstein(n[1], i / n[0], t);
  return height;
}

inline std::vector<double> random_heights(unsigned int n, double bound)
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> uniform(-bound, bound);
  std::vector<double>                    heights(n);
  for (double &height : heights)
    height = uniform(generator);
  return heights;
}

/// Blocks of edge 1 with @p n and @p m cells per edge; the foundation
/// clamped at the bottom, the punch on rollers at its sides, pressed from
/// above and held vertically only by contact.
template <int dim>
TestScene<dim> two_blocks(unsigned int n, unsigned int m, double radius)
{
  TestScene<dim> scene;
  scene.bodies.resize(2);
  for (auto &body : scene.bodies)
    for (unsigned int d = 0; d < dim; ++d)
      body.size[d] = 1.;
  auto &punch           = scene.bodies[0];
  auto &foundation      = scene.bodies[1];
  punch.corner[dim - 1] = 1.;
  punch.radius          = radius;
  punch.cells.assign(dim, n);
  foundation.cells.assign(dim, m);
  for (unsigned int d = 0; d + 1 < dim; ++d)
    for (unsigned int side = 0; side < 2; ++side)
      punch.supports[face_index(d, side)] = {d};
  punch.loads[face_index(dim - 1, 1)].pressure = 10.;
  for (unsigned int d = 0; d < dim; ++d)
    foundation.supports[face_index(dim - 1, 0)].push_back(d);
  return scene;
}

/// The punch narrower and in the middle, so that meshes do not match.
template <int dim>
void narrow_punch(TestScene<dim> &scene)
{
  for (unsigned int d = 0; d + 1 < dim; ++d)
    {
      scene.bodies[0].corner[d] = 0.17;
      scene.bodies[0].size[d]   = 0.64;
    }
}

template <int dim>
void set_design(TestScene<dim> &scene, unsigned int n, double bound)
{
  scene.control_points = {n, dim == 3 ? n : 1};
  scene.design         = random_heights(dim == 3 ? n * n : n, bound);
}

/// The scene as the program sees it: mesh, tearing, model, solver.
template <int dim>
class Problem
{
public:
  using Field = typename mesh::BodyMesh<dim>::Field;

  explicit Problem(const TestScene<dim> &scene, MPI_Comm communicator = MPI_COMM_WORLD)
    : scene(scene)
    , context(communicator, log)
    , mesh(communicator,
           mesh_parameters(scene),
           scene.degree,
           scene.idealization,
           {scene.subdomains, "grid"})
    , tearing(mesh::tear(mesh, scene.cluster_edge))
    , model(make_model(scene))
    , solver(mesh, tearing, model, mesh.reference_positions(), context)
  {}

  /// Node positions of heights @p design.
  Field positions(const std::vector<double> &design) const
  {
    const unsigned int body = 1;
    Field              x    = mesh.reference_positions();
    for (unsigned int node = 0; node < x.size(); ++node)
      if (mesh.body_of_node(node) == body)
        {
          const auto f = mesh.geometry(body).box_fraction(mesh.logical_positions()[node]);
          x[node][dim - 1] +=
            f[dim - 1] * bezier_height(scene.control_points, design, f[0], dim == 3 ? f[1] : 0.);
        }
    mesh.interpolate_hanging(x);
    return x;
  }

  state::ContactState<dim> solve(const std::vector<double> &design)
  {
    return solver.solve(positions(design), qp::WarmStart());
  }

  state::ContactState<dim> solve() { return solve(scene.design); }

  static std::vector<geometry::BodyMeshParameters> mesh_parameters(const TestScene<dim> &scene)
  {
    std::vector<geometry::BodyMeshParameters> result;
    for (const auto &body : scene.bodies)
      {
        geometry::BodyMeshParameters parameters;
        for (unsigned int d = 0; d < dim; ++d)
          {
            parameters.corner.push_back(body.corner[d]);
            parameters.size.push_back(body.size[d]);
          }
        parameters.cells = body.cells;
        if (body.radius > 0.)
          parameters.curved_faces["bottom"] =
            (dim == 3 ? "sphere " : "cylinder z ") + std::to_string(body.radius);
        if (body.sampled)
          parameters.sampled_boundaries = {"bottom", "top"};
        if (body.refined_below > 0.)
          {
            parameters.refine_where      = std::to_string(body.refined_below) + "-x";
            parameters.local_refinements = 1;
          }
        if (body.core_from < 1e10)
          parameters.region_formulas = {{"core", "x - " + std::to_string(body.core_from)}};
        result.push_back(parameters);
      }
    return result;
  }

  static state::BodyLoads<dim> make_loads(const TestBody<dim>                 &body,
                                          const typename TestBody<dim>::Loads &loads)
  {
    using Point = dealii::Point<dim>;
    state::BodyLoads<dim> result;
    const auto            b = body.body_force;
    if (b.norm() > 0.)
      result.body_force = [b](const Point &) { return b; };
    result.temperature = body.temperature;
    for (const auto &entry : loads)
      {
        const auto load   = entry.second;
        auto      &of     = result.boundaries[entry.first];
        const auto factor = [load](const Point &x) { return load.factor ? load.factor(x) : 1.; };
        of.pressure       = [=](const Point &x) { return factor(x) * load.pressure; };
        of.traction       = [=](const Point &x) { return factor(x) * load.traction; };
        of.resultant      = load.resultant;
        of.concentrated   = load.concentrated;
      }
    return result;
  }

  static state::Model<dim> make_model(const TestScene<dim> &scene)
  {
    state::Model<dim> model;
    model.body_names = {"punch", "foundation", "block"};
    model.body_names.resize(scene.bodies.size());
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const auto &body = scene.bodies[b];
        model.bodies.push_back({{body.material, body.core}, body.formulation});
        for (const auto &support : body.supports)
          for (const unsigned int component : support.second)
            model.supports.push_back({b, support.first, component, {}, "support"});
        for (const auto &[boundary, springs] : body.springs)
          for (const auto &[component, k] : springs)
            model.springs.push_back({b,
                                     boundary,
                                     component,
                                     [k = k](const dealii::Point<dim> &) { return k; },
                                     {},
                                     {"Springs", "spring"},
                                     "spring"});
        for (auto support : body.prescribed)
          {
            support.body = b;
            model.supports.push_back(support);
          }
      }
    const unsigned int n_cases = std::max<std::size_t>(1, scene.cases.size());
    for (unsigned int c = 0; c < n_cases; ++c)
      {
        model.load_cases.push_back({"case " + std::to_string(c), {}, {}});
        if (scene.are_steps && c > 0)
          model.load_cases.back().after = c - 1;
        for (unsigned int b = 0; b < scene.bodies.size(); ++b)
          model.load_cases.back().bodies.push_back(
            make_loads(scene.bodies[b],
                       scene.cases.empty() ? scene.bodies[b].loads : scene.cases[c][b]));
      }
    for (const auto &pair : scene.pairs)
      (pair.parameters.law == contact::Law::tied ? model.ties : model.pairs).push_back(pair);
    if (scene.pairs.empty() && scene.bodies.size() > 1)
      {
        model.pairs = {{{0, face_index(dim - 1, 0)}, {1, face_index(dim - 1, 1)}}};
        model.pairs[0].parameters.slave  = contact::Slave::first;
        model.pairs[0].parameters.method = scene.method;
        auto &parameters                 = model.pairs[0].parameters;
        parameters.friction              = scene.friction;
        (scene.friction == contact::Friction::Tresca ? parameters.friction_bound
                                                     : parameters.friction_coefficient) =
          scene.friction_value;
      }
    model.feti   = scene.feti;
    model.solver = scene.solver;
    return model;
  }

  const TestScene<dim>    scene;
  std::ostringstream      log;
  RunContext              context;
  mesh::BodyMesh<dim>     mesh;
  mesh::Tearing           tearing;
  state::Model<dim>       model;
  state::StateSolver<dim> solver;
};

/// |a - b| over the larger of the two.
inline double relative_difference(double a, double b)
{
  return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
}
} // namespace snug::test

#endif
