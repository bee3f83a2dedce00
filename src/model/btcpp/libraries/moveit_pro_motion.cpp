// SPDX-License-Identifier: MIT
//
// MoveIt Pro: behaviors that plan, move and ask. After the objectives of
// PickNikRobotics/moveit_pro_example_ws, its main branch behind 9.4.1
// (f9f967b7): each row names a package below its src, and an objective there
// that uses the type. A port that is given a literal somewhere, or an entry
// that was there before, is an input; one that names an entry for the first
// time is an output.
#include "model/btcpp/libraries/libraries.hpp"

namespace btcheck::btcpp {
namespace {

constexpr LibraryType kMotionTypes[] = {
    // lab_sim, add_table_to_planning_scene
    {"AddCollisionBox", "Action", "object_id dimensions pose overwrite"},
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"AddCollisionMesh", "Action",
     "object_id mesh_file_path pose scale overwrite"},
    // kitchen_sim, generate_graspable_object
    {"AddCollisionObject", "Action", "collision_object overwrite"},
    // factory_sim, add_bins_to_planning_scene
    {"AddURDF", "Action", "urdf_name urdf_pose package_name urdf_file_path"},
    // factory_sim, pick_up_tool_from_holder
    {"AttachURDF", "Action",
     "urdf_name allowed_collision_links parent_link_name"},
    // dual_arm_sim, sort_blocks
    {"BiasedCoinFlip", "Action", "success_probability"},
    // lab_sim, octomap_example
    {"BreakpointSubscriber", "Action", "breakpoint_topic message"},
    // lab_sim, stationary_admittance
    {"CallTriggerService", "Action",
     "service_name response_timeout wait_for_server_available_timeout"},
    // lab_sim, take_snap
    {"ClearSnapshot", "Action"},
    // hangar_sim, compute_ik_plan_and_move
    {"ComputeInverseKinematics", "Action",
     "ik_timeout_s link_padding planning_group_name planning_scene_msg "
     "target_poses tip_links",
     "solution"},
    // factory_sim, inspect_convex_bowl
    {"ComputeLinkPoseForwardKinematics", "Action",
     "joint_state link_name planning_scene", "link_pose"},
    // hangar_sim, navigate_to_clicked_point
    {"ComputePathToPoseAction", "Action",
     "action_name goal ignore_stamp_time start timeout_sec use_start "
     "planner_id",
     "path planning_time"},
    // space_satellite_sim, grapple_moving_satellite_via_fiducial_tracking
    {"ComputeVelocityToAlignWithTarget", "Action",
     "proportional_gain_angular proportional_gain_linear end_effector_frame "
     "target_motion_state target_pose_offset",
     "output_control_velocity output_pose_error"},
    // lab_sim, stitch_multiple_point_clouds_together
    {"ConvertMtcSolutionToJointTrajectory", "Action", "solution",
     "joint_trajectory"},
    // lab_sim, stationary_admittance
    {"CreateStationaryTrajectory", "Action", "joint_state trajectory_duration",
     "joint_trajectory_msg"},
    // factory_sim, detach_and_remove_tool
    {"DetachURDF", "Action", "urdf_name"},
    // hangar_sim, request_teleoperation
    {"DoTeleoperateAction", "Action"},
    // hangar_sim, move_to_pose_no_preview
    {"ExecuteMTCSolution", "Action",
     "solution execution_pipeline controller_action_name "
     "goal_duration_tolerance"},
    // vla_sim, stack_cubes_with_the_vla_policy
    {"ExecutePolicy", "Action",
     "policy_service_name joint_group_name prompt total_action_steps dt "
     "committed_action_steps num_interpolation_points goal_path_tolerance "
     "policy_tracking_weight policy_uses_real_time_chunking guidance_horizon "
     "policy_call_timeout image_topics image_names joint_states_topic "
     "absolute_force_torque_threshold gripper_command_action_name "
     "gripper_joint_name"},
    // dual_arm_sim, draw
    {"ExecuteTrajectory", "Action",
     "controller_action_name execution_pipeline joint_trajectory_msg "
     "goal_duration_tolerance absolute_force_torque_threshold "
     "admittance_parameters_msg goal_position_tolerance "
     "path_position_tolerance"},
    // hangar_sim, navigate_to_clicked_point
    {"FollowPathAction", "Action",
     "action_name controller_id goal_checker_id path timeout_sec",
     "distance_to_goal speed"},
    // lab_sim, move_with_velocity_and_force
    {"ForceExceedsThreshold", "Action",
     "minimum_consecutive_wrench_values wrench_frame_name hand_frame_name "
     "force_threshold wrench_topic_name"},
    // kitchen_sim, wipe_text
    {"GenerateCoveragePath", "Action",
     "bottom_right_corner stride_distance width height", "vector_of_poses"},
    // kinova_sim, demo_trajectory_stitching
    {"GeneratePointToPointTrajectory", "Action",
     "jerk_scale_factor velocity_scale_factor acceleration_scale_factor "
     "planning_group_name start_state start_time target_state "
     "trajectory_sampling_rate",
     "joint_trajectory_msg"},
    // lab_sim, stationary_admittance
    {"GetCurrentPlanningScene", "Action", "", "planning_scene_msg"},
    // lab_sim, stationary_admittance
    {"GetJointState", "Action", "planning_scene planning_group_name",
     "joint_state"},
    // space_satellite_sim, grapple_moving_satellite_via_fiducial_tracking
    {"GetOdom", "Action", "odometry_topic_name",
     "odometry_pose subscribed_odometry"},
    // lab_sim, playback_square_trajectory
    {"GetRobotStateFromTrajectory", "Action",
     "from_start joint_trajectory_msg time_from_reference", "joint_state"},
    // factory_sim, retract
    {"InitializeMTCTask", "Action", "timeout task_id", "task"},
    // factory_sim, automated_return_held_tool
    {"IsAnyObjectAttached", "Action", "planning_scene"},
    // lab_sim, addcollisionobjecttoplanningscene
    {"IsCollisionObjectInPlanningScene", "Action",
     "planning_scene collision_object_name"},
    // hangar_sim, solution_draw_square
    {"IsUserAvailable", "Action"},
    // hangar_sim, request_teleoperation
    {"JointJog", "Action",
     "controller_name link_padding stop_safety_factor skip_collision_checks"},
    // lab_sim, reset_mujoco_robot
    {"ListControllers", "Action", "type state", "controller_list"},
    // lab_sim, mpc_pose_tracking_with_point_cloud_avoidance
    {"MPCPointCloudClearance", "Action",
     "differentiable follow_joint_trajectory_topic gradient_num_trajectory "
     "gradient_spline_points horizon planning_group sampling_control_width "
     "sampling_exploration sampling_sample_width sampling_spline_points "
     "set_ctrl_command_to_current_state timeout timestep warmup_iterations "
     "cartesian_acceleration cartesian_acceleration_body cartesian_velocity "
     "cartesian_velocity_body gripper_site_name link_sites "
     "max_cartesian_acceleration_goal max_cartesian_velocity_goal mujoco_model "
     "mujoco_model_package point_cloud point_cloud_clearance safe_distance "
     "target_pose target_twist site_tracking",
     "total_return"},
    // lab_sim, mpc_pose_tracking
    {"MPCPoseTracking", "Action",
     "horizon timestep gradient_num_trajectory gradient_spline_points "
     "planning_group sampling_control_width sampling_exploration "
     "sampling_sample_width sampling_spline_points timeout mujoco_model "
     "mujoco_model_package gripper_site_name differentiable "
     "max_cartesian_velocity_goal cartesian_velocity_body "
     "max_cartesian_acceleration_goal cartesian_acceleration_body "
     "warmup_iterations max_velocity_goal acceleration cartesian_acceleration "
     "cartesian_velocity force_torque site_tracking velocity "
     "follow_joint_trajectory_topic set_ctrl_command_to_current_state "
     "target_pose target_twist",
     "total_return"},
    // lab_sim, mpc_pose_tracking_with_static_sphere_point_cloud_avoidance
    {"MPCSphereClearance", "Action",
     "differentiable follow_joint_trajectory_topic gradient_num_trajectory "
     "gradient_spline_points horizon planning_group sampling_control_width "
     "sampling_exploration sampling_sample_width sampling_spline_points "
     "set_ctrl_command_to_current_state timestep cartesian_acceleration "
     "cartesian_acceleration_body cartesian_velocity cartesian_velocity_body "
     "collision_sphere_object gripper_site_name "
     "max_cartesian_acceleration_goal max_cartesian_velocity_goal mujoco_model "
     "mujoco_model_package safe_distance sphere_clearance target_pose "
     "target_twist warmup_iterations timeout site_tracking link_sites",
     "total_return"},
    // lab_sim, open_gripper
    {"MoveGripperAction", "Action",
     "gripper_command_action_name position timeout"},
    // hangar_sim, navigate_to_clicked_point_with_replanning
    {"NavigateToPoseAction", "Action",
     "action_name behavior_tree_path ignore_stamp_time pose_stamped"},
    // dual_arm_sim, draw
    {"PlanCartesianPath", "Action",
     "blending_radius ik_cartesian_space_density ik_joint_space_density path "
     "planning_group_name position_only trajectory_timing tip_offset tip_links "
     "tip_link acceleration_scale_factor trajectory_sampling_rate "
     "velocity_scale_factor max_optimizer_iterations",
     "debug_solution joint_trajectory_msg"},
    // factory_sim, retract
    {"PlanMTCTask", "Action", "task max_solutions", "solution"},
    // hangar_sim, compute_ik_plan_and_move
    {"PlanToJointGoal", "Action",
     "acceleration_scale_factor joint_goal link_padding max_iterations "
     "planning_group_name seed trajectory_sampling_rate velocity_scale_factor "
     "orientation_constraint",
     "joint_trajectory_msg"},
    // hangar_sim, request_teleoperation
    {"PoseJog", "Action",
     "controller_names link_padding planning_group_names stop_safety_factor "
     "include_octomap skip_collision_checks"},
    // lab_sim, record_square_trajectory
    {"RecordJointTrajectory", "Action",
     "joint_state_topic planning_group_name start_recording_service "
     "stop_recording_service timeout_sec joint_space_step",
     "joint_trajectory_message"},
    // factory_sim, detach_and_remove_tool
    {"RemoveURDFFromScene", "Action", "urdf_name"},
    // hangar_sim, ml_move_boxes_to_loading_zone
    {"RepeatUnlessFailureEachTick", "Decorator", "num_cycles"},
    // factory_sim, vacuum_pick_bracket_part_subtree
    {"RepeatUnlessFailureWithinTick", "Decorator", "num_cycles"},
    // kinova_sim, reset_simulation
    {"ResetMujocoKeyframe", "Action",
     "response_timeout wait_for_server_available_timeout keyframe_name"},
    // factory_sim, reset_planning_scene
    {"ResetPlanningSceneObjects", "Action", "apply_planning_scene_service"},
    // hangar_sim, request_teleoperation
    {"RetrievePoseParameter", "Action", "timeout_sec", "pose"},
    // hangar_sim, request_teleoperation
    {"RetrieveRobotStateParameter", "Action", "timeout_sec", "joint_state"},
    // dual_arm_sim, sort_blocks
    {"RetrieveWaypoint", "Action", "joint_group_name waypoint_name",
     "waypoint_joint_state"},
    // lab_sim, stationary_admittance
    {"SetAdmittanceParameters", "Action", "config_file_name",
     "admittance_parameters_msg"},
    // hangar_sim, navigate_to_clicked_point
    {"SetInitialPose", "Action", "robot_frame_id"},
    // lab_sim, reset_mujoco_robot
    {"SetMujocoState", "Action"},
    // lab_sim, place_at_pose
    {"SetupMTCBatchPoseIK", "Action",
     "end_effector_group end_effector_link ik_group ik_timeout_s "
     "max_ik_solutions monitored_stage target_poses",
     "", "task"},
    // picknik_ur_site_config, retreat_to_initial_pose
    {"SetupMTCCartesianMoveToRobotState", "Action",
     "joint_state planning_group_name", "", "task"},
    // lab_sim, place_at_pose
    {"SetupMTCConnectWithProRRT", "Action",
     "acceleration_scale_factor link_padding max_iterations "
     "planning_group_name seed trajectory_sampling_rate velocity_scale_factor",
     "", "task"},
    // factory_sim, retract
    {"SetupMTCCurrentState", "Action", "", "", "task"},
    // lab_sim, stitch_multiple_point_clouds_together
    {"SetupMTCFromSolution", "Action", "solution", "", "task"},
    // factory_sim, retract
    {"SetupMTCMoveAlongFrameAxis", "Action",
     "acceleration_scale axis_frame axis_x axis_y axis_z hand_frame "
     "ignore_environment_collisions max_distance min_distance "
     "planning_group_name velocity_scale",
     "", "task"},
    // factory_sim, plan_path_along_surface
    {"SetupMTCPathIK", "Action",
     "ignore_environment_collisions planning_group_name path tip_offset "
     "acceleration_scale_factor blending_radius ik_cartesian_space_density "
     "ik_joint_space_density position_only trajectory_sampling_rate "
     "velocity_scale_factor",
     "", "task"},
    // dual_arm_sim, sort_blocks
    {"SetupMTCPlanToPose", "Action",
     "acceleration_scale_factor ik_frame link_padding max_iterations "
     "monitored_stage planning_group_name target_pose trajectory_sampling_rate "
     "velocity_scale_factor orientation_constraint",
     "", "task"},
    // dual_arm_sim, sort_blocks
    {"SetupMTCPlanToRobotState", "Action",
     "acceleration_scale_factor joint_state link_padding max_iterations "
     "planning_group_name trajectory_sampling_rate velocity_scale_factor seed",
     "", "task"},
    // factory_sim, pick_up_tool_from_holder
    {"SetupMTCSetCollisionRule", "Action", "name_a name_b allow_collision", "",
     "task"},
    // picknik_ur_site_config, push_button
    {"SplitMTCSolution", "Action", "solution_in index",
     "solution_out_1 solution_out_2"},
    // dual_arm_sim, sort_blocks
    {"StopwatchBegin", "Action", "", "timepoint"},
    // dual_arm_sim, sort_blocks
    {"StopwatchEnd", "Action", "timepoint"},
    // dual_arm_sim, draw
    {"SwitchController", "Action",
     "activate_asap automatic_deactivation controller_list_action_name "
     "controller_switch_action_name strictness timeout activate_controllers "
     "deactivate_controllers automatic_activation"},
    // lab_sim, pick_object
    {"SwitchUIPrimaryView", "Action", "primary_view_name"},
    // lab_sim, octomap_example
    {"UpdatePlanningSceneService", "Action", "point_cloud point_cloud_service"},
    // lab_sim, load_and_execute_joint_trajectory
    {"ValidateTrajectory", "Action",
     "cartesian_space_step joint_space_step joint_trajectory_msg "
     "planning_group_name planning_scene_msg",
     "debug_solution"},
    // dual_arm_sim, sort_blocks
    {"WaitForDuration", "Action", "delay_duration"},
    // kitchen_sim, write_text
    {"WaitForMTCSolutionApproval", "Action", "cartesian_path_links solution"},
    // hangar_sim, navigate_to_clicked_point
    {"WaitForUserPathApproval", "Action", "path"},
    // factory_sim, automated_return_held_tool
    {"WhichObjectIsAttached", "Action", "planning_scene object_names",
     "object_name"},
};

}  // namespace

std::span<const LibraryType> moveit_pro_motion() { return kMotionTypes; }

}  // namespace btcheck::btcpp
