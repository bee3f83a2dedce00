// SPDX-License-Identifier: MIT
//
// MoveIt Pro: trees that it brings along, which no file of a workspace has.
// After the objectives of PickNikRobotics/moveit_pro_example_ws, as in
// moveit_pro_motion: each row names a package below its src, and an objective
// there that uses the tree without having it.
#include "model/btcpp/libraries/libraries.hpp"

namespace btcheck::btcpp {
namespace {

constexpr LibraryType kTrees[] = {
    // hangar_sim, calibrate_sam3_mask_areas
    {"AddToVector", "SubTree", "element input_vector", "output_vector"},
    // factory_sim, automask_camera_iterate_masks
    {"CreateVector", "SubTree", "", "vector"},
    // april_tag_sim, apriltag_pick_object
    {"Execute MTC Solution", "SubTree",
     "absolute_force_torque_threshold admittance_parameters_msg "
     "controller_action_name controller_names execution_pipeline "
     "goal_duration_tolerance goal_position_tolerance "
     "path_position_tolerance solution"},
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"Execute MTC Solution (JTC)", "SubTree",
     "controller_action_name controller_names goal_duration_tolerance "
     "solution"},
    // hangar_sim, point-to-point_trajectory
    {"Interpolate to Joint State", "SubTree",
     "acceleration_scale_factor controller_action_server "
     "controller_names execution_pipeline target_joint_state"},
    // kitchen_sim, grasp_object_from_point
    {"Move to Pose", "SubTree",
     "controller_names require_user_approval target_pose"},
    // hangar_sim, request_teleoperation
    {"Move to Pose (JTC)", "SubTree",
     "ik_frame link_padding planning_group_name require_user_approval "
     "target_pose"},
    // april_tag_sim, collect_angled_apriltag_detection_data
    {"Move to Waypoint", "SubTree",
     "acceleration_scale_factor controller_action_server "
     "controller_names execution_pipeline joint_group_name link_padding "
     "orientation_constraint planner_interface seed target_joint_state "
     "use_all_planners velocity_scale_factor waypoint_name"},
    // hangar_sim, cartesian_path_with_collision_checking
    {"Move to Waypoint (JTC)", "SubTree",
     "acceleration_scale_factor controller_action_server "
     "controller_names joint_group_name link_padding seed "
     "velocity_scale_factor waypoint_name"},
    // lab_sim, grasp_pose_tuning_with_april_tag
    {"Request Teleoperation", "SubTree",
     "enable_user_interaction initial_teleop_mode user_interaction_prompt"},
    // hangar_sim, move_boxes_looping
    {"Reset MuJoCo Sim", "SubTree", ""},
};

}  // namespace

std::span<const LibraryType> moveit_pro_trees() { return kTrees; }

}  // namespace btcheck::btcpp
