#include <snug/app/build_model.h>
#include <snug/mesh/formula.h>

namespace snug
{
  namespace app
  {
    namespace
    {
      template <int dim>
      dealii::Tensor<1, dim>
      to_tensor(const std::vector<double> &values)
      {
        dealii::Tensor<1, dim> tensor;
        for (unsigned int c = 0; c < dim && c < values.size(); ++c)
          tensor[c] = values[c];
        return tensor;
      }

      template <int dim>
      state::BodyModel<dim>
      body_model(const scene::Body             &body,
                 const mesh::BodyGeometry<dim> &geometry)
      {
        state::BodyModel<dim> model;
        model.materials = {body.material};
        model.formulation =
          choose(elasticity::formulation_table(), body.formulation).make();
        model.body_force = to_tensor<dim>(body.loads.body_force);
        for (const auto &entry : body.loads.pressure)
          model.loads[mesh::boundary_index(geometry, entry.first)].pressure =
            entry.second;
        for (const auto &entry : body.loads.traction)
          model.loads[mesh::boundary_index(geometry, entry.first)].traction =
            to_tensor<dim>(entry.second);
        return model;
      }

      template <int dim>
      contact::Pair
      find_pair(const scene::Scene                      &scene,
                const mesh::BodyMesh<dim>               &mesh,
                const contact::ContactParameters::Entry &entry)
      {
        contact::Pair pair;
        pair.slave       = find_face(scene, mesh, entry.slave);
        pair.slave_name  = entry.slave;
        pair.master_name = entry.master;
        pair.parameters  = entry.parameters;
        for (const auto &obstacle : scene.obstacles)
          if (obstacle.name == entry.master)
            pair.obstacle = obstacle;
        if (!pair.obstacle)
          pair.master = find_face(scene, mesh, entry.master);
        return pair;
      }

      /// A formula of the reference position as a function.
      template <int dim>
      std::function<double(const dealii::Point<dim> &)>
      function_of(const std::string &entry, const std::string &text)
      {
        const auto formula = std::make_shared<mesh::Formula<dim>>(entry, text);
        return
          [formula](const dealii::Point<dim> &x) { return formula->value(x); };
      }

      /// What holds one body; its index is left open.
      template <int dim>
      std::vector<state::Support<dim>>
      supports(const scene::Body &body, const mesh::BodyGeometry<dim> &geometry)
      {
        std::vector<state::Support<dim>> result;
        const std::string                section = "Body " + body.name + "/";
        const auto                       add     = [&](const std::string &entry,
                             const std::string &boundary,
                             unsigned int       component) {
          result.push_back({0,
                            mesh::boundary_index(geometry, boundary),
                            component,
                            {},
                            "'" + section + entry + "' of '" + boundary + "'"});
        };
        for (const auto &item : body.supports)
          for (const unsigned int c : scene::component_list(item.second, dim))
            add("Supports", item.first, c);
        for (const auto &item : body.displacements)
          {
            const auto parts = scene::split_displacement(item.second);
            add("Displacement",
                item.first,
                *scene::component_number(parts.first, dim));
            result.back().values.push_back(
              function_of<dim>(section + "Displacement", parts.second));
          }
        return result;
      }
    } // namespace

    std::vector<mesh::BodyMeshParameters>
    mesh_parameters(const scene::Scene &scene)
    {
      std::vector<mesh::BodyMeshParameters> parameters;
      for (const auto &body : scene.bodies)
        parameters.push_back(body.mesh);
      return parameters;
    }

    template <int dim>
    std::pair<unsigned int, unsigned int>
    find_face(const scene::Scene        &scene,
              const mesh::BodyMesh<dim> &mesh,
              const std::string         &face)
    {
      const auto         names = scene::split_face(face);
      const unsigned int body  = scene::body_index(scene, names.first);
      if (body == scene.bodies.size())
        throw InputError("there is no body '" + names.first + "'");
      return {body, mesh::boundary_index(mesh.geometry(body), names.second)};
    }

    template <int dim>
    state::Model<dim>
    build_model(const scene::Scene &scene, const mesh::BodyMesh<dim> &mesh)
    {
      state::Model<dim> model;
      model.feti   = scene.feti;
      model.solver = scene.solver;
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
        {
          const auto &body = scene.bodies[b];
          model.body_names.push_back(body.name);
          model.bodies.push_back(body_model(body, mesh.geometry(b)));
          for (auto support : supports(body, mesh.geometry(b)))
            {
              support.body = b;
              model.supports.push_back(support);
            }
        }
      for (const auto &entry : scene.contact.pairs)
        model.pairs.push_back(find_pair(scene, mesh, entry));
      return model;
    }

#define SNUG_INSTANTIATE(dim)                                          \
  template state::Model<dim> build_model(const scene::Scene &,         \
                                         const mesh::BodyMesh<dim> &); \
  template std::pair<unsigned int, unsigned int> find_face(            \
    const scene::Scene &, const mesh::BodyMesh<dim> &, const std::string &);
    SNUG_INSTANTIATE(2)
    SNUG_INSTANTIATE(3)
#undef SNUG_INSTANTIATE
  } // namespace app
} // namespace snug
