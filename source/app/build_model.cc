#include <snug/app/build_model.h>

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
          for (const auto &support : body.supports)
            {
              state::Support entry;
              entry.body = b;
              entry.boundary =
                mesh::boundary_index(mesh.geometry(b), support.first);
              for (const char component : support.second)
                entry.components.push_back(component - 'x');
              model.supports.push_back(entry);
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
