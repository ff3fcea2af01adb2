#include <snug/advice/cost.h>
#include <snug/base/values.h>
#include <snug/elasticity/element.h>
#include <snug/geometry/face_list.h>
#include <snug/mesh/parts.h>
#include <snug/response/response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <map>
#include <ostream>
#include <set>
#include <sstream>

namespace snug::advice {
namespace {
/// Return the number of nodes of a side without hanging nodes; 0 for an obstacle. Collective.
template <int dim>
double
count_nodes(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh, const std::string &side)
{
  std::vector<contact::Boundary> boundaries;
  for (const auto &face : geometry::face_list(side))
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      if (const auto [body, boundary] = scene::split_face(face);
          !boundary.empty() && scene.bodies[b].name == body)
        boundaries.emplace_back(b, geometry::boundary_index(mesh.geometry(b), boundary));
  // Several ranks have faces at a node, so that its owner counts it.
  std::map<unsigned int, std::vector<unsigned int>> nodes_of_owner;
  for (const auto &face : mesh.boundary_faces())
    if (std::find(boundaries.begin(), boundaries.end(),
                  contact::Boundary(face.body, face.boundary)) != boundaries.end())
      for (const unsigned int node : face.nodes)
        if (!mesh.is_hanging(node))
          nodes_of_owner[mesh.owner(node)].push_back(mesh.global_node(node));
  std::set<unsigned int> nodes;
  for (const auto &message :
       dealii::Utilities::MPI::some_to_some(mesh.communicator(), nodes_of_owner))
    nodes.insert(message.second.begin(), message.second.end());
  return dealii::Utilities::MPI::sum(static_cast<double>(nodes.size()), mesh.communicator());
}
} // namespace

template <int dim>
Counts count(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
{
  Counts result;
  result.cells = mesh.n_global_cells();
  result.nodes = mesh.n_global_free_nodes();
  for (const auto &pair : scene.contact.pairs)
    {
      const double slave = count_nodes(scene, mesh, pair.slave);
      result.contact_rows += pair.parameters.slave == contact::Slave::finer
                               ? std::max(slave, count_nodes(scene, mesh, pair.master))
                               : slave;
    }
  std::set<std::pair<unsigned int, unsigned int>> parts; // parts are numbered body by body
  std::vector<double>                             sums(3 * mesh.n_bodies() + 1,
                                                       0.); // cells, hanging and free nodes, subdomains
  for (const auto &cell : mesh.cells())
    {
      sums[3 * cell.body] += 1.;
      parts.insert({cell.body, cell.part});
    }
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(mesh.communicator());
  for (unsigned int node = 0; node < mesh.n_local_nodes(); ++node)
    if (mesh.owner(node) == rank)
      sums[3 * mesh.body_of_node(node) + (mesh.is_hanging(node) ? 1 : 2)] += 1.;
  sums.back() = parts.size();
  dealii::Utilities::MPI::sum(sums, mesh.communicator(), sums);
  result.subdomains  = sums.back();
  const auto by_size = mesh::cells_per_subdomain(dim, mesh.degree(), mesh.idealization());
  for (unsigned int b = 0; b < mesh.n_bodies(); ++b)
    {
      // The cells lie in layers if the body has a grid without local refinements.
      const bool has_layers = mesh.geometry(b).grid() && sums[3 * b + 1] == 0.;
      double     each       = has_layers ? by_size.compact : by_size.other;
      if (scene::is_nearly_incompressible(scene, scene.bodies[b]))
        each *= mesh::larger_subdomains(dim);
      // The cells of quadratic elements have fewer free nodes than other cells.
      const double cells = std::min(sums[3 * b], sums[3 * b + 2] / std::pow(mesh.degree(), dim));
      result.subdomains_by_size += std::max(1., std::round(cells / each));
      result.coarse_cells += mesh.geometry(b).n_coarse_cells();
      result.has_layers = result.has_layers && has_layers;
    }
  if (result.coarse_cells == result.cells)
    result.coarse_cells = 0.; // Only p4est needs them, which refines cells.
  return result;
}

namespace {
/// A stiffness matrix of 8 nodes on the machine of the constants below [s].
constexpr double seconds_per_element = 1.33e-6;

/// Constants of one dimension, fitted to the runs that contrib/studies/estimates measures: [s] and
/// [MB], the degree p = 1 or 2 being in what they multiply.
struct Constants
{
  double setup;              ///< per node
  double accuracy[2];        ///< per cell, of degree 1 and 2
  double output;             ///< per cell and node of it
  double factor, fill;       ///< per unknown n of a subdomain, and per n^fill_power
  double fill_power;         ///< flops of a nested dissection
  double apply, apply_power; ///< an F-mult, per n^apply_power of a subdomain
  double derivative;         ///< per cell, of a gradient and of each of its solves
  double node[2];            ///< memory per node, of degree 1 and 2
  double entries;            ///< memory per n^apply_power of a subdomain
  double subdomain;          ///< of the coarse problem, per subdomain
  double subdomain_memory;   ///< the same
};

constexpr Constants plane = {3e-5, {3e-5, 3.5e-5}, 1.7e-5,           5e-6, 3e-8, 1.5, 1.5e-7,
                             1.,   1.5e-6,         {0.0066, 0.0072}, 0.,   5e-4, 0.05};
constexpr Constants solid = {6e-5, {1.4e-4, 1.2e-3}, 6e-6,    4e-6,   7e-9, 2., 3.75e-8, 4. / 3.,
                             5e-6, {0.020, 0.026},   2.07e-4, 2.5e-3, 0.14};

/// Parts of a solve and of a picture that each load case after the first one takes.
const double further_solve = 0.5, further_picture = 0.25;

const double base_memory = 175.; ///< of a process [MB]
const double start_up    = 0.4;  ///< of libraries and MPI [s]

/// Return the number of clusters of subdomains, see mesh::find_clusters(). Whether soft modes keep
/// all subdomains apart is not known.
double expected_clusters(const scene::Scene &scene, const double subdomains)
{
  unsigned int edge = scene.tearing.cluster_edge;
  if (edge == 0 && subdomains <= mesh::most_single_clusters)
    return subdomains;
  const auto clusters = [&]() { return subdomains / std::pow(edge, scene.dimension); };
  for (edge = std::max(edge, scene.tearing.cluster_edge == 0 ? 2u : 1u);
       scene.tearing.cluster_edge == 0 && clusters() > mesh::most_clusters;)
    ++edge;
  return clusters();
}

/// Return the F-mults of a cold solve. Subdomains that are no boxes need twice as many.
double expected_f_mults(const scene::Scene &scene, const Counts &counts)
{
  double result = 10. + 6. * std::log2(std::max(1., counts.subdomains));
  if (!counts.has_layers || scene.tearing.method == "METIS")
    result *= 2.;
  if (expected_clusters(scene, counts.subdomains) < counts.subdomains)
    result *= 1.5;
  if (scene.degree == 2)
    result *= 1.5;
  if (scene.solver.method == "SMALSE-M")
    result *= 2.5;
  if (scene.feti.preconditioner != feti::Preconditioner::Dirichlet)
    result *= scene.feti.preconditioner == feti::Preconditioner::none ? 3. : 1.5;
  const double tolerance = scene.state_tolerance.value_or(1e-6);
  return result * (0.5 - std::log10(tolerance) / 12.);
}

/// Return the expected number of design variables of a scene.
double expected_variables(const scene::Scene &scene, const Counts &counts)
{
  double result = 0.;
  for (const auto &shape : scene.shapes)
    if (!shape.modes.empty())
      result += shape.modes.size();
    else if (!shape.control_points.empty())
      {
        double points = 1.;
        for (const unsigned int n : shape.control_points)
          points *= n;
        result += points;
      }
    else if (shape.moves())
      result += counts.contact_rows;
  return result;
}

/// Responses whose gradient takes a solve.
template <int dim>
double solving_responses(const scene::Scene &scene)
{
  std::vector<std::string> names = {scene.optimization.objective};
  if (scene.task == scene::Task::optimize)
    for (const auto &constraint : scene.optimization.constraints)
      names.push_back(scene::constraint_name(scene, constraint.first).response);
  return std::count_if(names.begin(), names.end(), [&](const std::string &name) {
    const auto response = response::make_response<dim>(*scene::response_called(scene, name));
    return response->needs_solution() && (!scene::has_potential(scene) || !response->stationary());
  });
}

/// Seconds of one rank that did it all alone.
void estimate_times(const scene::Scene &scene, const Constants &of, const double n, Cost &cost)
{
  const auto        &counts  = cost.counts;
  const unsigned int p       = scene.degree - 1;
  const double       cases   = std::max<std::size_t>(1, scene.load_cases.size());
  const double       f_mults = expected_f_mults(scene, counts);
  const double       f_mult  = counts.subdomains * of.apply * std::pow(n, of.apply_power) + 1e-4;
  // Patterns and factors of the coarse problem grow faster than its size. Clusters bound its size.
  const double clusters = expected_clusters(scene, counts.subdomains);
  cost.setup =
    of.setup * counts.nodes + of.subdomain * (counts.subdomains + clusters * clusters / 8000.);
  cost.factorization = counts.subdomains * (of.factor * n + of.fill * std::pow(n, of.fill_power));
  // Further load cases start from the forces of the ones before them.
  cost.solve    = (1. + further_solve * (cases - 1.)) * f_mults * f_mult;
  cost.accuracy = scene.accuracy.estimate == accuracy::Estimate::none
                    ? 0.
                    : cases * of.accuracy[p] * counts.cells;
  if (scene.accuracy.estimate == accuracy::Estimate::responses)
    cost.accuracy += double(scene.responses.size()) * cost.solve;
  // The mesh is prepared once for the pictures of all load cases.
  const double pictures =
    (1. + further_picture * (cases - 1.)) * (scene.task == scene::Task::optimize ? 2. : 1.);
  cost.output = pictures * of.output * counts.cells * std::pow(scene.degree + 1., cost.dimension);
  if (scene.task == scene::Task::state)
    return;
  const double variables = expected_variables(scene, counts);
  const double solves    = std::min(variables, cost.dimension == 2 ? solving_responses<2>(scene)
                                                                   : solving_responses<3>(scene));
  const double state     = cost.factorization + cost.solve;
  using Method           = sensitivity::Method;
  const bool differences = scene.gradient.method == Method::finite_differences ||
                           (scene.task == scene::Task::sensitivity && scene.gradient.compare);
  const double rhs = scene.gradient.method == Method::direct ? variables : solves;
  cost.gradient    = 0.8 * rhs * cost.solve + (1. + rhs) * of.derivative * counts.cells;
  if (differences)
    cost.gradient += 2. * variables * state;
  cost.design    = state + cost.gradient;
  cost.n_designs = scene.task == scene::Task::optimize ? scene.optimization.maximum_evaluations : 1;
}
} // namespace

double machine_speed()
{
  using Clock = std::chrono::steady_clock;
  const elasticity::Element<3>      element(1);
  std::vector<dealii::Tensor<1, 3>> X;
  for (unsigned int v = 0; v < 8; ++v)
    X.push_back(dealii::Point<3>(v & 1, v >> 1 & 1, v >> 2));
  std::vector<double> K;
  double              least = 1e300;
  // the least of several, as others may be at work
  for (unsigned int turn = 0; turn < 30; ++turn)
    {
      const auto         start = Clock::now();
      const unsigned int n     = 300;
      for (unsigned int i = 0; i < n; ++i)
        element.stiffness(X, {}, K);
      least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count() / n);
    }
  return seconds_per_element / least;
}

/// Subdomains are made smaller, as by mesh::decide_parts(), until every rank has one.
Cost estimate_cost(const scene::Scene &scene,
                   Counts              given,
                   const unsigned int  ranks,
                   const double        speed)
{
  while (given.subdomains < std::min<double>(ranks, given.cells))
    given.subdomains *= 2.;
  Cost cost;
  cost.counts             = given;
  cost.dimension          = scene.dimension;
  cost.ranks              = ranks;
  const Constants &of     = scene.dimension == 2 ? plane : solid;
  const auto      &counts = cost.counts;
  const double     dim    = scene.dimension;
  const double     nodes  = std::min(counts.nodes, counts.cells * std::pow(scene.degree, dim));
  const double     n      = dim * std::pow(std::pow(nodes / counts.subdomains, 1. / dim) + 1., dim);
  const double     mesh =
    of.node[scene.degree - 1] * counts.nodes +
    counts.subdomains * (of.subdomain_memory + of.entries * std::pow(n, of.apply_power));
  const double coarse = ranks == 1 ? 0. : 1e-3 * counts.coarse_cells;
  cost.memory_largest = base_memory + mesh / ranks + coarse;
  cost.memory_total   = ranks * cost.memory_largest;
  estimate_times(scene, of, n, cost);
  const double share = 1. / (speed * ranks);
  for (double *seconds : {&cost.setup, &cost.factorization, &cost.solve, &cost.accuracy,
                          &cost.output, &cost.gradient, &cost.design})
    *seconds *= share;
  cost.start = start_up / speed;
  cost.total =
    cost.start + cost.setup + cost.accuracy + cost.output +
    (cost.n_designs > 0 ? cost.n_designs * cost.design : cost.factorization + cost.solve);
  return cost;
}

namespace {
/// Two digits, or all before the point.
std::string seconds_text(const double seconds)
{
  std::ostringstream text;
  text.precision(2);
  if (seconds < 10.)
    text << seconds;
  else
    text << std::llround(seconds);
  return text.str() + " s";
}
} // namespace

void print(const Cost &cost, const bool stages, std::ostream &out)
{
  const auto whole      = [](const double number) { return std::llround(number); };
  const auto counted_as = [](const double number, const char *noun) {
    return counted(static_cast<std::size_t>(std::llround(number)), noun);
  };
  out << "estimate: " << counted_as(cost.counts.cells, "cell") << ", "
      << counted_as(cost.dimension * cost.counts.nodes, "unknown") << ", at most "
      << counted_as(cost.counts.contact_rows, "contact condition") << ", "
      << counted_as(cost.counts.subdomains, "subdomain")
      << "\nestimate: " << whole(cost.memory_total) << " MB";
  if (cost.ranks > 1)
    out << " on " << cost.ranks << " ranks, " << whole(cost.memory_largest) << " MB on one";
  out << ", " << seconds_text(cost.total);
  if (cost.n_designs > 0)
    out << " for " << (cost.n_designs > 1 ? "at most " : "") << counted(cost.n_designs, "design")
        << ", " << seconds_text(cost.design) << " each, of which the gradient takes "
        << seconds_text(cost.gradient);
  out << '\n';
  const std::pair<const char *, double> rows[] = {
    {"start", cost.start}, {"setup", cost.setup},       {"factorization", cost.factorization},
    {"solve", cost.solve}, {"accuracy", cost.accuracy}, {"output", cost.output}};
  for (const auto &[name, seconds] : rows)
    if (stages)
      out << "  " << std::left << std::setw(14) << name << seconds_text(seconds) << '\n';
  out << std::flush;
}

template Counts count(const scene::Scene &, const mesh::BodyMesh<2> &);
template Counts count(const scene::Scene &, const mesh::BodyMesh<3> &);
} // namespace snug::advice
