// SPDX-License-Identifier: MIT
//
// MoveIt Pro: behaviors that look, compute and keep data. After the objectives
// of PickNikRobotics/moveit_pro_example_ws, its main branch behind 9.4.1
// (f9f967b7): each row names a package below its src, and an objective there
// that uses the type. A port that is given a literal somewhere, or an entry
// that was there before, is an input; one that names an entry for the first
// time is an output.
#include "model/btcpp/libraries/libraries.hpp"

namespace btcheck::btcpp {
namespace {

constexpr LibraryType kDataTypes[] = {
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"AddPoseStampedToVector", "Action", "input", "", "vector"},
    // picknik_ur_site_config, teach_apriltag_grasp_offset
    {"AdjustPoseWithIMarker", "Action", "initial_poses prompts",
     "adjusted_poses"},
    // kinova_sim, sample_april_tag
    {"AveragePoseStamped", "Action", "pose_sample num_samples run_continuously",
     "avg_pose max_distance max_rotation"},
    // space_satellite_sim_camera_cal, calibrate_camera_-_tag_tfs
    {"AveragePoseStampedVector", "Action", "pose_stamped_vector",
     "average_pose_stamped"},
    // april_tag_sim, move_to_and_detect_tag_0
    {"CalculatePoseOffset", "Action", "destination_pose source_pose",
     "source_to_destination_pose"},
    // space_satellite_sim_camera_cal, camera_pose_from_cal_tool_-_tag_tfs
    {"CalibrateCameraPose", "Action",
     "base_link calibration_tool_frame right_tag_pose left_tag_pose "
     "bottom_tag_pose camera_optical_frame",
     "computed_pose"},
    // lab_sim, pick_all_bottles_with_apriltags
    {"ComputeTrayPlacePositionsUsingAprilTags", "Action",
     "detections camera_info input_image tray_apriltag_id num_rows "
     "columns_per_row row_spacing column_spacing tag_to_tray_center "
     "bottle_diameter visualization_topic",
     "place_positions"},
    // lab_sim, ml_find_bottles_on_table_from_image_exemplar
    {"CreateBoundingBoxFromOffset", "Action", "exemplar_image padding_percent",
     "bounding_boxes"},
    // lab_sim, mpc_pose_tracking_with_static_sphere_point_cloud_avoidance
    {"CreateCollisionSpheresAtClosestPoints", "Action",
     "closest_point_count filter_cylinder_height filter_cylinder_radius "
     "point_cloud reference_pose sphere_radius debug_output_markers",
     "collision_object marker_scale_xyz marker_poses"},
    // lab_sim, pick_object
    {"CreatePoseStamped", "Action",
     "reference_frame orientation_xyzw position_xyz", "pose_stamped"},
    // lab_sim, reset_mujoco_robot
    {"CreateRobotState", "Action", "joint_names positions velocities",
     "joint_state_msg"},
    // lab_sim, vector_and_string_example
    {"CreateStringMessage", "Action", "data", "string"},
    // lab_sim, force_relaxation
    {"CreateTwistStamped", "Action",
     "reference_frame angular_velocity_xyz linear_velocity_xyz",
     "twist_stamped"},
    // lab_sim, force_relaxation
    {"CreateWrenchStamped", "Action", "reference_frame torque_xyz force_xyz",
     "wrench_stamped"},
    // lab_sim, segment_bottle_subtree
    {"CropPointsInBox", "Action",
     "crop_box_centroid_pose point_cloud crop_box_size", "point_cloud_cropped"},
    // lab_sim, get_april_tag_pose_from_image
    {"DetectAprilTags", "Action",
     "image camera_info apriltag_family_name max_hamming n_threads "
     "quad_decimate quad_sigma refine_edges tag_size",
     "detections"},
    // picknik_ur_site_config, push_button_ml
    {"ExtractGraspableObjectPose", "Action", "graspable_object", "pose"},
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"FilterMasks2DByArea", "Action", "masks min_area max_area",
     "filtered_masks"},
    // lab_sim, addbottlestoplanningscene
    {"FindMaskedObjects", "Action",
     "base_frame camera_info face_separation_threshold masks2d "
     "minimum_face_area plane_inlier_threshold point_cloud",
     "detected_shapes"},
    // picknik_ur_site_config, detect_hinge_line_segment
    {"FitLineSegmentToMask3D", "Action",
     "point_cloud mask3d base_frame max_distance_from_line_for_inlier",
     "line_segment_poses"},
    // grinding_sim, visualize_poses
    {"ForEach", "Decorator", "vector_in", "out index"},
    // lab_sim, segment_bottle_subtree
    {"ForEachUntilSuccess", "Decorator", "vector_in", "index out"},
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"GenerateVacuumGraspPoses", "Action",
     "ee_to_tcp_tf end_effector_group_name generate_centroid_grasps "
     "num_orientation_samples padding_dimension planning_scene_msg "
     "samples_per_plane target_object ui_grasp_link",
     "grasp_poses"},
    // lab_sim, segment_bottle_subtree
    {"GetCameraInfo", "Action",
     "topic_name message_timeout_sec publisher_timeout_sec", "message_out"},
    // dual_arm_sim, find_with_prompt
    {"GetCentroidFromPointCloud", "Action", "point_cloud", "output_pose"},
    // hangar_sim, plan_path_along_surface
    {"GetContourFromPointCloudSlice", "Action",
     "max_pose_spacing hull_alpha input_cloud slice_distance_from_plane "
     "slice_plane contour_crop_angle_span contour_crop_angle_start",
     "contour_path"},
    // lab_sim, get_april_tag_pose_from_image
    {"GetDetectionPose", "Action", "detections target_id target_label",
     "detection_pose"},
    // dual_arm_sim, find_with_prompt
    {"GetElementOfVector", "Action", "index vector_in", "element"},
    // kitchen_sim, generate_graspable_object
    {"GetGraspableObjectsFromMasks3D", "Action",
     "base_frame masks3d minimum_face_area plane_inlier_threshold point_cloud "
     "face_separation_threshold",
     "graspable_objects"},
    // lab_sim, segment_bottle_subtree
    {"GetImage", "Action",
     "topic_name message_timeout_sec publisher_timeout_sec", "message_out"},
    // hangar_sim, calibrate_sam3_mask_areas
    {"GetMask2DProperties", "Action", "mask", "width height area"},
    // picknik_ur_site_config, push_button_ml
    {"GetMasks2DAction", "Action",
     "image action_name min_confidence max_nms_iou min_relative_area "
     "max_relative_area timeout_sec valid_classes",
     "masks2d"},
    // factory_sim, automask_from_file
    {"GetMasks2DAutomask", "Action",
     "grid_size image score_threshold decoder_model_path encoder_model_path "
     "prompt_encoder_model_path nms_threshold model_package min_component_area",
     "mask_count masks2d"},
    // lab_sim, segment_bottle_subtree
    {"GetMasks2DFromExemplar", "Action",
     "model_package encoder_model_path decoder_model_path "
     "geometry_encoder_model_path text_encoder_model_path confidence_threshold "
     "target_image text_prompt exemplar_bboxes exemplar_image target_bboxes",
     "masks2d mask_count confidence_scores_str confidence_scores"},
    // kitchen_sim, grasp_object_from_point
    {"GetMasks2DFromPointQuery", "Action",
     "image pixel_coords decoder_model_path encoder_model_path model_package",
     "masks2d"},
    // lab_sim, segment_bottle_subtree
    {"GetMasks3DFromMasks2D", "Action", "camera_info masks2d point_cloud",
     "masks3d"},
    // factory_sim, reachability_analysis_for_mesh
    {"GetMeshNormalPoses", "Action", "discretization_step_size link_name",
     "mesh_normal_poses"},
    // lab_sim, take_snap
    {"GetPointCloud", "Action",
     "topic_name message_timeout_sec publisher_timeout_sec", "message_out"},
    // lab_sim, segment_bottle_subtree
    {"GetPointCloudFromMask3D", "Action", "point_cloud mask3d",
     "point_cloud_fragment"},
    // kitchen_sim, grasp_object_from_point
    {"GetPointsFromUser", "Action", "view_name point_prompts point_names",
     "pixel_coords"},
    // picknik_ur_site_config, push_button
    {"GetPoseFromPixelCoords", "Action",
     "point_cloud pixel_coords downsample_fraction neighbor_radius",
     "output_poses"},
    // hangar_sim, navigate_to_clicked_point
    {"GetPoseFromUser", "Action", "is_normal pose_prompt view_name",
     "user_pose"},
    // lab_sim, errorcheckvectorsize
    {"GetSizeOfVector", "Action", "vector_in", "vector_size"},
    // kinova_sim, compliant_grasp_rafti_vfc
    {"GetSyncedImageAndPointCloud", "Action",
     "point_cloud_topic_name rgb_image_topic_name rgb_camera_info_topic_name",
     "point_cloud rgb_image rgb_camera_info"},
    // lab_sim, addbottlestoplanningscene
    {"InsertInVector", "Action", "index element input_vector", "output_vector"},
    // space_satellite_sim, grapple_moving_satellite_via_fiducial_tracking
    {"IsPoseNearIdentity", "Action",
     "pose position_tolerance rotation_tolerance"},
    // factory_sim, automask_from_file
    {"LoadImageFromFile", "Action", "frame_id file_path package_name", "image"},
    // lab_sim, playback_square_trajectory
    {"LoadJointTrajectoryFromYaml", "Action", "file_path", "output"},
    // lab_sim, register_cad_part
    {"LoadPointCloudFromFile", "Action",
     "color package_name file_path frame_id num_sampled_points scale "
     "random_seed",
     "point_cloud"},
    // lab_sim, grasp_pose_using_yaml
    {"LoadPoseStampedFromYaml", "Action", "file_path", "output"},
    // dual_arm_sim, draw
    {"LoadPoseStampedVectorFromYaml", "Action", "file_path", "output"},
    // lab_sim, load_mujoco_robot_state
    {"LoadRobotJointStateFromYaml", "Action", "file_path", "output"},
    // lab_sim, octomap_example
    {"LogMessage", "Action", "log_level message"},
    // lab_sim, fuse_multiple_views_subtree
    {"MergePointClouds", "Action",
     "align_point_clouds grid_resolution_meters icp_correspondence_distance "
     "icp_max_iterations point_clouds",
     "merged_cloud"},
    // hangar_sim, move_boxes_to_loading_zone_from_waypoint
    {"OverridePoseOrientation", "Action", "input_pose orientation_xyzw",
     "output_pose"},
    // lab_sim, ml_find_bottles_on_table_from_image_exemplar
    {"PublishBoundingBoxes2D", "Action", "image bounding_boxes"},
    // hangar_sim, move_to_a_stampedpose
    {"PublishEmpty", "Action", "topic queue_size use_best_effort"},
    // lab_sim, mpc_pose_tracking_with_static_sphere_point_cloud_avoidance
    {"PublishMarkers", "Action",
     "marker_type marker_namespace marker_scale_xyz marker_poses"},
    // factory_sim, automask_from_file
    {"PublishMask2D", "Action",
     "image masks masks_visualization_topic opacity "
     "bounding_box_detection_class bounding_box_labels"},
    // picknik_ur_base_config, visualize_segmented_point_cloud
    {"PublishPointCloud", "Action", "point_cloud point_cloud_topic"},
    // lab_sim, vector_and_string_example
    {"PublishString", "Action", "queue_size use_best_effort message topic"},
    // dual_arm_sim, draw
    {"PublishTF", "Action", "pose child_frame_id publish_rate"},
    // lab_sim, force_relaxation
    {"PublishVelocityForceCommand", "Action",
     "force_controlled_axes wrench_gain velocity_controlled_axes publish_rate "
     "twist wrench velocity_force_controller_command_topic"},
    // lab_sim, place_object
    {"PushBackVector", "Action", "input_vector element", "output_vector"},
    // lab_sim, vector_and_string_example
    {"ReadTextFileAsString", "Action", "text_filename", "string_file_contents"},
    // lab_sim, register_cad_part
    {"RegisterPointClouds", "Action",
     "target_point_cloud base_point_cloud max_iterations "
     "max_correspondence_distance",
     "target_pose_in_base_frame"},
    // lab_sim, vector_and_string_example
    {"RemoveFromVector", "Action", "input_vector index", "output_vector"},
    // lab_sim, segment_bottle_subtree
    {"RemovePointsInBox", "Action",
     "point_cloud remove_box_centroid_pose remove_box_size",
     "point_cloud_culled"},
    // lab_sim, vector_and_string_example
    {"ReplaceInVector", "Action", "element index input_vector",
     "output_vector"},
    // lab_sim, place_at_pose
    {"ResetPoseStampedVector", "Action", "", "vector"},
    // lab_sim, place_object
    {"ResetVector", "Action", "", "vector"},
    // hangar_sim, raster_path_along_fuselage
    {"ReversePoseStampedVector", "Action", "input_vector", "output_vector"},
    // picknik_ur_site_config, push_button
    {"SaveCurrentState", "Action", "", "saved_robot_state"},
    // lab_sim, stitch_multiple_point_clouds_together
    {"SaveImageToFile", "Action", "image file_path"},
    // lab_sim, plan_and_save_trajectory
    {"SaveJointTrajectoryToYaml", "Action", "yaml_filename message overwrite"},
    // grinding_sim, capture_point_cloud
    {"SavePointCloudToFile", "Action", "file_path file_prefix point_cloud"},
    // space_satellite_sim_camera_cal, calibrate_camera_-_tag_tfs
    {"SavePoseForUrdf", "Action", "calibration_pose_stamped file_name"},
    // grinding_sim, save_tool_pose_yaml
    {"SavePoseStampedToYaml", "Action",
     "message yaml_filename namespace overwrite"},
    // lab_sim, save_robot_joint_state
    {"SaveRobotJointStateToYaml", "Action", "message yaml_filename"},
    // lab_sim, take_snap
    {"SendPointCloudToUI", "Action",
     "pcd_topic point_cloud use_latest_transform"},
    // lab_sim, register_cad_part
    {"TransformPointCloud", "Action", "input_cloud transform_pose",
     "output_cloud"},
    // lab_sim, register_cad_part
    {"TransformPointCloudFrame", "Action", "input_cloud target_frame",
     "output_cloud"},
    // dual_arm_sim, sort_blocks
    {"TransformPose", "Action",
     "input_pose quaternion_xyzw translation_xyz marker_lifetime marker_size "
     "marker_text visualize_pose",
     "output_pose"},
    // lab_sim, mpc_pose_tracking
    {"TransformPoseFrame", "Action", "input_pose target_frame_id",
     "output_pose"},
    // lab_sim, mpc_pose_tracking
    {"TransformPoseWithPose", "Action", "input_pose transform_pose",
     "output_pose"},
    // lab_sim, addbottlestoplanningscene
    {"UnpackCollisionObjectMessage", "Action", "collision_object",
     "header id mesh_poses meshes operation plane_poses planes pose "
     "primitive_poses primitives subframe_names subframe_poses type"},
    // lab_sim, addbottlestoplanningscene
    {"UnpackGraspableObjectMessage", "Action", "graspable_object",
     "object object_color grasp_info"},
    // kinova_sim, demo_trajectory_stitching
    {"UnpackJointStateMessage", "Action", "joint_state",
     "effort header name_ position velocity"},
    // lab_sim, addbottlestoplanningscene
    {"UnpackPointMessage", "Action", "point", "x y z"},
    // lab_sim, addbottlestoplanningscene
    {"UnpackPoseMessage", "Action", "pose", "orientation position"},
    // factory_sim, inspect_convex_bowl
    {"UnpackRobotStateMessage", "Action", "robot_state",
     "joint_state multi_dof_joint_state"},
    // lab_sim, vector_and_string_example
    {"UnpackStringMessage", "Action", "string", "data"},
    // lab_sim, force_relaxation
    {"UnpackTwistStampedMessage", "Action", "twist_stamped", "twist header"},
    // lab_sim, force_relaxation
    {"UnpackWrenchStampedMessage", "Action", "wrench_stamped", "wrench header"},
    // lab_sim, visualize_grasp_link
    {"VisualizeMesh", "Action",
     "marker_lifetime mesh_path mesh_pose mesh_name"},
    // dual_arm_sim, draw
    {"VisualizePath", "Action",
     "marker_lifetime path marker_name pose_marker_size show_poses"},
    // lab_sim, pick_object
    {"VisualizePose", "Action",
     "marker_lifetime marker_name marker_size pose marker_text"},
};

}  // namespace

std::span<const LibraryType> moveit_pro_data() { return kDataTypes; }

}  // namespace btcheck::btcpp
