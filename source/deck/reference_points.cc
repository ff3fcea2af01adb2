#include <snug/base/values.h>
#include <snug/deck/scene_loads.h>

namespace snug::deck {
namespace {
using Step   = DeckModel::Step;
using Point  = dealii::Point<3>;
using Vector = dealii::Tensor<1, 3>;

/// This struct collects the entries of reference nodes.
struct PointCollector
{
  const DeckModel                 &model;
  const DeckBodies                &bodies;
  const std::vector<const Step *> &steps;
  Remarks                         &remarks;
  SceneLoads                      &loads;
  const unsigned int               dim    = bodies.dimension();
  const bool                       is_one = steps.size() == 1;

  void collect()
  {
    std::map<unsigned int, std::vector<Entry>> points; // by reference node
    for (const auto &rigid : model.rigid_bodies)
      if (rigid.is_distributing)
        distribute(rigid);
      else
        for (const unsigned int b : rigid.bodies)
          for (const auto &boundary : bodies.boundaries(b, bodies.faces_on(b, rigid.set)))
            add_item(points[rigid.reference_node], "Faces", bodies.all()[b].name + "." + boundary,
                     {rigid.line});
    for (const auto &obstacle : model.obstacles)
      {
        const auto &rigid = model.rigid_bodies[obstacle.rigid_body];
        const auto  node  = rigid.reference_node;
        loads.of_obstacles.push_back(points.count(node) > 0 ? Entry() : displacement_of(node));
        if (loads.of_obstacles.back().value.empty())
          add_item(points[node], "Obstacles", obstacle.name, {rigid.line});
      }
    for (const auto &[node, followers] : points)
      add(node, followers);
  }

  /// Return whether a reference node has a component, 0 to 5 with rotations.
  bool has(const unsigned int c) const
  {
    return dim == 3 || (model.model == "axisymmetric" ? c == 1 : c < 2 || c == 5);
  }

  /// Return the displacement of a rigid body that is held in all components, equally in all steps,
  /// without rotations and loads, or an empty entry.
  Entry displacement_of(const unsigned int node) const
  {
    std::vector<double> displacement(6, 0.);
    Entry               entry{"Displacement"};
    for (const auto *step : steps)
      for (unsigned int c = 0; c < 6; ++c)
        if (c == 0 || has(c))
          {
            const auto found = step->motions.find({node, c});
            if (found == step->motions.end() || step->reference_loads.count({node, c}) > 0 ||
                (c >= dim && found->second.value != 0.) ||
                (step != steps.front() && found->second.value != displacement[c]))
              return {};
            displacement[c] = found->second.value;
            entry.add_line(found->second.line);
          }
    displacement.resize(dim);
    entry.value = to_text(displacement, ' ');
    return entry;
  }

  void add(const unsigned int node, const std::vector<Entry> &followers)
  {
    const auto name    = "point-" + std::to_string(loads.points.size() + 1);
    const auto key     = is_one ? "" : name + ": ";
    auto      &entries = loads.points.emplace_back(name, followers).second;
    entries.insert(entries.begin(), {"Point", to_text(bodies.position(node))});
    for (unsigned int c = 0; c < 6; ++c)
      if (has(c))
        hold(node, c, key, entries);
    for (unsigned int s = 0; s < steps.size(); ++s)
      add_load(*steps[s], node, {0, 1, 2, 3, 4, 5}, bodies.point(node), key,
               is_one ? entries : loads.cases[s].entries);
  }

  /// Add the support of a component, or its displacements in the steps that hold it.
  void hold(const unsigned int  node,
            const unsigned int  c,
            const std::string  &key,
            std::vector<Entry> &entries)
  {
    const std::string name = (c < 3 ? "" : "r") + std::string(1, "xyz"[c % 3]);
    const auto        of   = [&](const Step *step) { return step->motions.find({node, c}); };
    if (std::all_of(steps.begin(), steps.end(), [&](const Step *step) {
          return of(step) != step->motions.end() && of(step)->second.value == 0.;
        }))
      return add_item(entries, "Supports", name, {of(steps[0])->second.line});
    for (unsigned int s = 0; s < steps.size(); ++s)
      if (const auto found = of(steps[s]); found != steps[s]->motions.end())
        add_item(is_one ? entries : loads.cases[s].entries, "Displacement",
                 key + name + " = " + to_text(found->second.value), {found->second.line});
  }

  /// Add 'Force' and 'Moment' about @p place of a reference node. Components that are not among the
  /// @p allowed ones, or that the model does not have, are noted as lacking.
  void add_load(const Step                   &step,
                const unsigned int            node,
                const std::set<unsigned int> &allowed,
                const Point                  &place,
                const std::string            &key,
                std::vector<Entry>           &entries)
  {
    Vector                     force, moment;
    std::vector<unsigned long> lines;
    for (unsigned int c = 0; c < 6; ++c)
      if (const auto found = step.reference_loads.find({node, c});
          found != step.reference_loads.end())
        for (const auto &given : found->second)
          {
            lines.push_back(given.line);
            if (allowed.count(c) > 0 && has(c))
              (c < 3 ? force : moment)[c % 3] += given.value;
            else
              remarks.lacks("cload",
                            "*CLOAD of component " + std::to_string(c + 1) +
                              ", which its reference node does not have",
                            given.line);
          }
    const auto         &p         = bodies.point(node);
    const auto          torque    = moment + cross_product_3d(p - place, force);
    const double        size      = moment.norm() + (p.norm() + place.norm()) * force.norm();
    const char          separator = key.empty() ? ',' : ' ';
    std::vector<double> moments;
    for (unsigned int d = 0; d < 3; ++d)
      if (has(d + 3))
        moments.push_back(rounded(torque[d], size));
    if (force.norm() > 0.)
      add_item(entries, "Force",
               key + to_text(std::vector<double>(force.begin_raw(), force.begin_raw() + dim),
                             separator),
               lines);
    if (std::any_of(moments.begin(), moments.end(), [](const double m) { return m != 0.; }))
      add_item(entries, "Moment", key + to_text(moments, separator), lines);
  }

  /// Add the loads of the reference node of a distributing coupling as those of its boundary.
  void distribute(const DeckModel::RigidBody &coupling)
  {
    const auto node  = coupling.reference_node;
    const auto lacks = [&](const std::string &what) {
      remarks.lacks("distributing", "*DISTRIBUTING " + what, coupling.line);
    };
    if (std::count_if(model.rigid_bodies.begin(), model.rigid_bodies.end(),
                      [&](const auto &other) { return other.reference_node == node; }) > 1)
      return lacks("with the reference node of several couplings or rigid bodies");
    for (const auto *step : steps)
      for (const auto &motion : step->motions)
        if (motion.first.first == node && has(motion.first.second))
          return lacks("with a reference node that *BOUNDARY holds");
    const auto b          = coupling.bodies[0];
    const auto boundaries = bodies.boundaries(b, bodies.faces_on(b, coupling.set));
    if (coupling.bodies.size() > 1 || boundaries.size() > 1)
      return lacks("over several boundaries, because parts of its surface belong to other sets");
    const auto centroid = centroid_of(coupling.set);
    const auto key      = (is_one ? "" : bodies.all()[b].name + ".") + boundaries[0] + ": ";
    for (unsigned int s = 0; s < steps.size(); ++s)
      add_load(*steps[s], node, coupling.components, centroid, key,
               is_one ? loads.of_bodies[b] : loads.cases[s].entries);
  }

  /// Return the centroid of the faces of a set. Lines of plane models are faces of the height 1.
  Point centroid_of(const std::string &set) const
  {
    double area = 0.;
    Point  sum;
    for (const auto &face : bodies.faces_of(set))
      {
        std::vector<Point> X;
        for (const unsigned int corner : face)
          X.push_back(bodies.point(corner));
        if (dim == 2)
          X.insert(X.end(), {X[1] + Vector({0., 0., 1.}), X[0] + Vector({0., 0., 1.})});
        for (std::size_t i = 2; i < X.size(); ++i)
          {
            const double part = cross_product_3d(X[i - 1] - X[0], X[i] - X[0]).norm();
            area += part;
            sum += part / 3. * (X[0] + X[i - 1] + X[i]);
          }
      }
    return sum / area;
  }
};
} // namespace

void add_reference_points(const DeckModel                            &model,
                          const DeckBodies                           &bodies,
                          const std::vector<const DeckModel::Step *> &steps,
                          Remarks                                    &remarks,
                          SceneLoads                                 &loads)
{
  PointCollector{model, bodies, steps, remarks, loads}.collect();
}
} // namespace snug::deck
