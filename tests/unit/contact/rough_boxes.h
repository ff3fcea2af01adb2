#ifndef snug_tests_unit_contact_rough_boxes_h
#define snug_tests_unit_contact_rough_boxes_h

#include <gtest/gtest.h>

#include "row_checks.h"

/// Two boxes with Coulomb friction, in any position of the bodies.
template <int dim>
struct RoughBoxes : public TwoBoxes<dim>
{
  using typename TwoBoxes<dim>::Bodies;
  using typename TwoBoxes<dim>::Field;
  using Vector = dealii::Tensor<1, dim>;

  RoughBoxes(const Bodies &bodies, unsigned int degree) : TwoBoxes<dim>(bodies, degree)
  {
    rough.parameters.friction             = snug::contact::Friction::Coulomb;
    rough.parameters.friction_coefficient = "0.3";
  }

  snug::contact::Contact<dim> contact() const
  {
    return {this->surface, {rough}, this->mesh.degree(), this->positions, this->held, position};
  }

  /// Turn all bodies and obstacles.
  void turn()
  {
    for (const unsigned int body : {0, 1})
      position.bodies[body].Q = some_rotation<dim>();
    position.obstacles["ball"].Q = some_rotation<dim>();
  }

  void raise_slave(double distance)
  {
    for (unsigned int node = 0; node < this->positions.size(); ++node)
      if (!this->is_master(node))
        this->positions[node][dim - 1] += distance;
  }

  /// Replace the master by a ball that moves.
  void meet_ball()
  {
    rough.obstacle.emplace();
    rough.obstacle->name  = "ball";
    rough.obstacle->shape = "sphere";
    rough.obstacle->point.assign(dim, 0.4);
    rough.obstacle->displacement.assign(dim, 0.05);
    rough.obstacle->displacement[0] = -0.2;
    rough.obstacle->radius          = 0.5;
    rough.parameters.largest_angle  = 180.;
    rough.obstacle->complete(dim);
  }

  /// Return the tangent of a tangential row in space, the sum of its coefficients at slave nodes.
  Vector tangent(const snug::contact::Contact<dim> &contact,
                 const snug::contact::Row<dim>     &row) const
  {
    Vector sum;
    for (const auto &[node, c] : row.coefficients)
      if (!this->is_master(node))
        sum += contact.placed_surface().turned(node, c);
    return sum;
  }

  snug::contact::Pair          rough = TwoBoxes<dim>::pair();
  snug::contact::Position<dim> position;
};

/// Call check(scene, is_flat) for flat and curved bodies apart that match or not, and both methods.
template <int dim, typename Check>
void for_each_rough_scene(const Check &check)
{
  using Scene = RoughBoxes<dim>;
  using snug::contact::Method;
  const std::pair<const char *, typename Scene::Bodies> scenes[] = {
    {"flat, matching", Scene::boxes(3, 3)},
    {"flat", Scene::boxes(3, 4)},
    {"bent, matching", Scene::boxes(3, 3)},
    {"bent, hanging", Scene::hanging_boxes()},
    {"round", Scene::ball_and_socket(3, 4, 2.)}};
  for (const Method method : {Method::nodal, Method::mortar})
    for (const unsigned int degree : {1, 2})
      for (const auto &[name, bodies] : scenes)
        {
          const std::string text = name;
          SCOPED_TRACE(std::to_string(dim) + "D, degree " + std::to_string(degree) +
                       (method == Method::nodal ? ", nodal, " : ", mortar, ") + text);
          Scene scene(bodies, degree);
          scene.rough.parameters.method = method;
          if (text.find("bent") == 0)
            scene.bend();
          if (text != "round")
            scene.raise_slave(0.07);
          check(scene, text.find("flat") == 0);
        }
}

#endif
